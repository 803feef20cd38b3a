// Generated from web/server/openapi.json by `npm run generate`: do not edit.
export interface paths {
    "/api/v1/account": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Who is logged in; a guest has no account. */
        get: operations["show_account"];
        put?: never;
        /** Makes an account and enters it. A name that is taken gets 409: names stand beside plugins, so they are no secret. */
        post: operations["make_account"];
        /**
         * Deletes the account for good: how it is entered, what it was told and has chosen, its tokens, and whatever of its things is
         *     not public. What is public stays, because it is cited, and belongs to a former account without a name. Nobody gets the name
         *     again. `GET /data.tar` takes everything along first.
         */
        delete: operations["delete_account"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/address": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Gives the account an address for its mails. A link goes there, and the address counts once it was opened; another address counts
         *     no more. The answer is the same whoever else has this address.
         */
        put: operations["give_address"];
        post?: never;
        /** Forgets the account's address, with all mails that wait to go there. */
        delete: operations["forget_address"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/address/confirmation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Confirms the account's address by the secret of the link that went there. */
        post: operations["confirm_address"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/choices": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** What the account has chosen, and where its mails go. */
        get: operations["show_choices"];
        /** Changes choices; what is absent stays as it is. */
        put: operations["choose"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/deletion-preview": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** What would go with the account and what would stay, and why it cannot be deleted, if so. */
        get: operations["show_deletion_preview"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/developer": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Asks the curators to be made a developer, who submits plugins. */
        post: operations["ask_to_develop"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/invitation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Accepts an invitation for the account that is logged in, which is a developer from then on. */
        post: operations["accept_invitation"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/login": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Enters an account. A wrong name and a wrong password get the same answer, in the same time. */
        post: operations["log_in"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/logout": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Leaves the account in this browser. */
        post: operations["log_out"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/logout-everywhere": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Leaves the account in every browser; tokens stay. */
        post: operations["log_out_everywhere"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/password": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Changes the password and leaves the account in every browser. */
        post: operations["change_password"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/signing-key": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Registers the key that plugins of this account are signed with, in the place of an earlier one. */
        post: operations["register_key"];
        /** Forgets the key; plugins that were signed with it stay signed. */
        delete: operations["forget_key"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Tokens for programs, without their secrets. */
        get: operations["list_tokens"];
        put?: never;
        /**
         * Makes a token; its secret is in this answer and nowhere else. Asked again under the same `Idempotency-Key`, it is the same token
         *     with another secret.
         */
        post: operations["make_token"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/account/tokens/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /** Ends a token. */
        delete: operations["end_token"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/accounts": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Accounts, newest first; those that want to be developers say why. */
        get: operations["list_accounts"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/accounts/{id}/role": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Gives an account a role. Curators decide about users and developers, administrators about all. */
        post: operations["change_role"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/advice": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Asks for advice; it is worked on when its turn comes. */
        post: operations["ask_advice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/advice/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** How far it is, and the advice when it is done. */
        get: operations["show_advice"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/advice/{id}/cancel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Ends it; what has ended stays as it is. */
        post: operations["cancel_advice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/advice/{id}/certificate.json": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The certificate of a reduced object; `ocb advise --verify` checks it beside the OBJ file. */
        get: operations["reduced_certificate"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/advice/{id}/reduced.obj": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** A reduced object as OBJ. */
        get: operations["reduced_obj"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/algorithms": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The installed and the public algorithms, and the visitor's own. */
        get: operations["list_algorithms"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/board": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Speed against accuracy over the finished runs that the service shows to everybody and the visitor's own. */
        get: operations["show_board"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/board.csv": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The rows of the board as CSV with a header line. */
        get: operations["show_board_csv"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/campaigns": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Campaigns, newest first, without their results. */
        get: operations["list_campaigns"];
        put?: never;
        /**
         * Has stored benchmarks measured again on this hardware class, suite and oracle, after whatever anybody waits for. With an
         *     `Idempotency-Key` the same request, sent again because its answer was lost, gives the same campaign.
         */
        post: operations["create_campaign"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/campaigns/preview": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** How many runs a campaign would queue now, and how long they take. Nothing is queued. */
        get: operations["preview_campaign"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/campaigns/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** One campaign: how far it is, with old and new results side by side. */
        get: operations["show_campaign"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/campaigns/{id}/cancel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Ends what waits of a campaign; the run at work comes to its end, and one that has ended stays as it is. */
        post: operations["cancel_campaign"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/curation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Everything that waits for a curator, oldest first. */
        get: operations["list_curation"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/data": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Everything that the visitor has made, which is what `DELETE` takes away, and until when it stays. */
        get: operations["show_data"];
        put?: never;
        post?: never;
        /**
         * Takes away everything that the visitor has made, with the stored files that nobody else uses; runs under way end. Plugins
         *     stay, because results belong to them.
         */
        delete: operations["delete_all"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/data.tar": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Everything that the visitor has made, to take along: objects, runs with their configurations and records, advice with its
         *     reduced objects, plugins with their reports, the account and its notices. A token gets no account data, and plugins only with their
         *     scope.
         */
        get: operations["export_data"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/data/keep": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Keeps what a guest has made for as long again, from now on. */
        post: operations["keep_longer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/estimates": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Number of configurations and expected time of a run that is not asked for yet. */
        post: operations["estimate_run"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/featured": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * The finished run that the start page shows; null until the first one is finished.
         * @description No 404: nothing has gone wrong then, and a browser would note every look of a waiting page as an error.
         */
        get: operations["featured_run"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/invitations": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Invitations, newest first, without their secrets. */
        get: operations["list_invitations"];
        put?: never;
        /**
         * Invites somebody to be a developer. The link is in this answer and nowhere else; whoever has it may accept, once. Asked again
         *     under the same `Idempotency-Key`, it is the same invitation with another link.
         */
        post: operations["invite"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/invitations/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /** Withdraws an invitation that nobody has accepted. */
        delete: operations["revoke_invitation"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/mails/off/{secret}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Turns off the mails of the account that a mail with this link went to, without logging in, and nothing else; doing it again changes
         *     nothing. Mail programs send the same to the link itself, which `List-Unsubscribe` names (RFC 8058); what they send along is not
         *     read. Whoever opens the link sees a page with a button.
         */
        post: operations["turn_mails_off"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/notices": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** What the account was told, newest first; the 500 newest are kept. */
        get: operations["list_notices"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/notices/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /** Takes a notice away, and the mail of it that has not gone yet. */
        delete: operations["remove_notice"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/notices/{id}/read": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Marks a notice as read; the first time stands. */
        post: operations["read_notice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/objects": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Stock objects, in front of the first part and beyond its limit, then the visitor's own and those that others have
         *     published, newest first.
         */
        get: operations["list_objects"];
        put?: never;
        /**
         * Uploads an OBJ file; the same mesh twice is one. Whoever has its id may look at it, and only its owner sees it in the list, until that decides
         *     otherwise.
         */
        post: operations["add_object"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/objects/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** One object: `stock:<name>@<triangles>`, `stock:bunny`, `stock:dragon` or the id of an upload. */
        get: operations["show_object"];
        put?: never;
        post?: never;
        /** Takes away an object, and the visitor's runs and advice with it; runs of others keep their numbers, and show no object. */
        delete: operations["remove_object"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/objects/{id}/deletion-preview": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** What goes with an object: the visitor's runs and advice with it. */
        get: operations["deletion_preview_of_object"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/objects/{id}/mesh.glb": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * The mesh as glTF binary: positions in f32, triangles in file order, so that triangle and vertex numbers are those of
         *     the records and heatmaps.
         */
        get: operations["object_mesh"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/objects/{id}/visibility": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /** Decides who sees an object; only who added it may. Runs and advice with a private object are private, too. */
        put: operations["change_object_visibility"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/openapi.json": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** This document. */
        get: operations["show_document"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/plugins": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The public plugins and those of the visitor, newest first; each one's report and history stand on its own page. */
        get: operations["list_plugins"];
        put?: never;
        /** Sends a plugin, which is then checked. The same bytes twice are one. */
        post: operations["submit_plugin"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/plugins/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * One plugin with its report and its history. One that was never public is shown to its author and to curators; to others
         *     it is not there.
         */
        get: operations["show_plugin"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/plugins/{id}/citation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The stable link of a plugin, and how it is cited: BibTeX and CFF. */
        get: operations["cite_plugin"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/plugins/{id}/decisions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Takes a step on a plugin's way. The author offers, answers and withdraws; curators decide, but not about their own; either
         *     ends its check.
         */
        post: operations["decide"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/plugins/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The plugin after every line of its report, as server-sent events; ends with the check. */
        get: operations["follow_plugin"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The visitor's runs, newest first. A part holds fewer than asked for where the object of a run was hidden from them. */
        get: operations["list_runs"];
        put?: never;
        /** Asks for a run. With an `Idempotency-Key` the same request, sent again because its answer was lost, gives the same run. */
        post: operations["start_run"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** One run. */
        get: operations["show_run"];
        put?: never;
        post?: never;
        /** Takes away a run with its results and the stored files that nobody else uses; one under way ends. */
        delete: operations["remove_run"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/cancel": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Cancels a queued or running run; a finished one stays as it is. Curators may cancel any run, in a browser session. */
        post: operations["cancel_run"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/chart": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** A chart of a run: its series with n and intervals. */
        get: operations["show_chart"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/chart.csv": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The points of a chart as CSV with a header line. */
        get: operations["chart_as_csv"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/chart.parquet": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The points of a chart as Parquet. */
        get: operations["chart_as_parquet"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/citation": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The stable link of a run that has ended, and how it is cited: BibTeX and CFF. */
        get: operations["cite_run"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/columns.arrow": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Every column that selections know of one algorithm, one value per configuration of the set (NaN where there is none),
         *     as an Arrow IPC stream. Columns that cannot be had are left out.
         */
        get: operations["columns_arrow"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/configurations.parquet": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The run's configurations with their truth as Parquet; `ocb bench --configurations` reads it again. */
        get: operations["configurations_parquet"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/configurations/{configuration}/contacts": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** All pairs of triangles that meet in one configuration, by the oracle. */
        get: operations["show_meeting"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/deletion-preview": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** What goes with a run. */
        get: operations["deletion_preview_of_run"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/ecdf": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Empirical distribution of the time per query. */
        get: operations["show_ecdf"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Progress of a run.
         * @description Each event has the run's sequence number as `id` and a `RunEvent` as `data`. With `Last-Event-ID` the stream begins
         *     behind that event; without it, at the first. It ends with the run; who connects again then gets 204, which tells an
         *     `EventSource` to stop.
         */
        get: operations["follow_run"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/heatmap": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Values on the vertices of one object of the run. */
        get: operations["show_heatmap"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/heatmap.glb": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The heatmap as glTF binary: `COLOR_0` (linear) for viewers, `_VALUE` (f32) for programs, `extras.ocb` says what it is. */
        get: operations["heatmap_glb"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/heatmap.ply": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The heatmap as PLY: `red green blue` (sRGB) and `quality` (the value). */
        get: operations["heatmap_ply"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/records.csv": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The records of one algorithm as CSV with a header line. */
        get: operations["records_csv"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/records.parquet": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The records of one algorithm as Parquet. */
        get: operations["records_parquet"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/refine": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Queues a run that has ended as a preview for all of its configurations.
         * @description Its numbers stay until those of the whole are there.
         */
        post: operations["refine_run"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/repro.zip": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * The run with all that its answers follow from, as one file: `ocb replay` asks every question again. For a run that is not public a
         *     token needs the scope for plugins.
         */
        get: operations["repro_zip"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/selection": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** How many configurations a selection holds, and what they cost each algorithm. */
        get: operations["show_selection"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/vertices/{vertex}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The value at one vertex, as the heatmap has it. */
        get: operations["show_vertex"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/visibility": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /** Decides who sees a run; only who asked for it may, and no more than see its objects. A public one is on everybody's board. */
        put: operations["change_run_visibility"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/witnesses.arrow": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Where every configuration has its witness points, in the objects' own frames, the triangles that hold them, and the
         *     certified distance, as an Arrow IPC stream.
         */
        get: operations["witnesses_arrow"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{id}/worst": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The worst configurations of an algorithm: wrong answers first, missed collisions before all. */
        get: operations["list_worst"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/stability": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Families, relations and reported failures, with the newest result of every method that was tried. */
        get: operations["show_stability"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/status": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** How busy the service is. */
        get: operations["show_status"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/suite": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The suite of this service, and how far each public algorithm has come with it on this machine. */
        get: operations["show_suite"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /** @description What was in the link. */
        Acceptance: {
            /** @description The secret. */
            secret: string;
        };
        /** @description An account, as its owner and curators see it. */
        AccountInfo: {
            /**
             * Format: int64
             * @description When it was made.
             */
            created_us: number;
            /** @description Why its owner wants to be a developer, while that is undecided. */
            developer_request?: string | null;
            /** @description Its id. */
            id: string;
            /** @description Its name, as it is shown beside plugins. */
            name: string;
            /** @description What it may do. */
            role: components["schemas"]["Role"];
            /** @description The minisign key that its plugins may be signed with. */
            signing_key?: string | null;
        };
        /**
         * @description A measure of accuracy.
         * @enum {string}
         */
        Accuracy: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
        /**
         * @description A step on a plugin's way.
         * @enum {string}
         */
        Action: "offer" | "answer" | "withdraw" | "approve" | "ask" | "reject" | "suspend" | "exclude" | "reinstate" | "end_check";
        /** @description What is advised for a scene. */
        Advice: {
            /**
             * Format: int32
             * @description Configurations from which the advice was made.
             */
            configurations: number;
            /** @description Where on the objects detail is needed. */
            detail: components["schemas"]["AdviceDetail"][];
            /** @description Relative distances at which configurations were looked for. */
            distances: number[];
            /** @description Time of the whole objects, asked for the distance, over that of the advice. */
            faster: components["schemas"]["Measured"];
            /** @description The same, the whole objects being asked the same question: a yes or no, or a distance only within the tolerance. */
            faster_than_same_question: components["schemas"]["Measured"];
            /**
             * Format: double
             * @description The same for any configuration whatever, if the whole objects were never asked.
             */
            guaranteed_anywhere?: number | null;
            /**
             * Format: double
             * @description Half the widest interval on the configurations, for a distance: no answer was or could have been further off.
             */
            guaranteed_error?: number | null;
            /** @description What advice says of configurations it was not made from. */
            held_out: components["schemas"]["HeldOut"];
            /** @description Ways that are missing among them. */
            left_out: components["schemas"]["AdviceLeftOut"][];
            /** @description The levels of A, finest first; the first is the object. */
            levels_a: components["schemas"]["LevelFacts"][];
            /** @description The levels of B. */
            levels_b: components["schemas"]["LevelFacts"][];
            /**
             * Format: double
             * @description L, the longest side of A's bounding box.
             */
            longest_side: number;
            /** @description Ways to answer, measured on the same configurations. */
            points: components["schemas"]["AdvicePoint"][];
            /** @description What was asked. */
            question: components["schemas"]["AdviceQuestion"];
            /**
             * Format: double
             * @description What the work took, seconds.
             */
            seconds: number;
            /** @description Levels to ask one after the other before the whole objects; none when those are the fastest. */
            stages: number[][];
            /**
             * Format: int32
             * @description Triangles of the first stage.
             */
            triangles_after: number;
            /**
             * Format: int32
             * @description Triangles of both objects.
             */
            triangles_before: number;
        };
        /** @description One object's vertices. */
        AdviceDetail: {
            /** @description Configurations at the vertex. */
            counts: number[];
            /**
             * @description Triangles of the coarsest level of the object that was enough for every configuration whose witness point is at
             *     the vertex; absent where there is none.
             */
            triangles: (number | null)[];
        };
        /** @description A request for advice and what became of it. */
        AdviceInfo: {
            advice?: components["schemas"]["Advice"] | null;
            /**
             * Format: int64
             * @description Steps done of `total`.
             */
            done: number;
            /** @description Id; whoever knows it may look. */
            id: string;
            /** @description Why it failed. */
            message?: string | null;
            /** @description Names of the objects. */
            names: string[];
            /** @description What was asked. */
            spec: components["schemas"]["AdviceSpec"];
            /** @description How far it is. */
            state: components["schemas"]["State"];
            /** @description What is being done. */
            step: string;
            /**
             * Format: int64
             * @description All steps.
             */
            total: number;
        };
        /**
         * @description What kind of model a way asks.
         * @enum {string}
         */
        AdviceKind: "whole" | "same_question" | "yes_no" | "levels" | "advised" | "hulls" | "boxes" | "convex_parts" | "inner_spheres" | "voxels" | "double_precision" | "single_precision";
        /** @description What is not on the plot, and why. */
        AdviceLeftOut: {
            /** @description In one sentence. */
            reason: string;
            /** @description As `ocb bench` calls them, or a word for what is no algorithm. */
            what: string[];
        };
        /** @description A way to answer. */
        AdvicePoint: {
            /** @description Is it the advice? */
            advised: boolean;
            /** @description What another method is called where it can be measured by itself (`ocb bench`), with its setting. */
            algorithm?: string | null;
            /**
             * Format: int32
             * @description How many of the configurations it was asked about, drawn at random, where all of them would take too long.
             */
            asked?: number | null;
            /** @description Can it not be wrong by more than it says? */
            certified: boolean;
            /**
             * Format: int32
             * @description How large the first model asked is, of both objects together.
             */
            elements: number;
            falls_back?: components["schemas"]["Share"] | null;
            false_alarms?: components["schemas"]["Share"] | null;
            /** @description How many times faster than the whole objects asked for their distance, about the same configurations. */
            faster: components["schemas"]["Measured"];
            /**
             * Format: double
             * @description No answer was or could have been further off (half the widest interval); absent where nothing is certified.
             */
            guaranteed_error?: number | null;
            /** @description What is asked. */
            kind: components["schemas"]["AdviceKind"];
            /** @description Time of a query, microseconds. */
            micros: components["schemas"]["Measured"];
            missed?: components["schemas"]["Share"] | null;
            /**
             * Format: double
             * @description The largest error seen.
             */
            observed_error?: number | null;
            /** @description Numbers of the levels, coarsest stage first; none for what is no level. */
            stages: number[][];
            /** @description In what that is counted. */
            unit: components["schemas"]["AdviceUnit"];
        };
        /** @description What is asked of every configuration; lengths are the objects' own. */
        AdviceQuestion: {
            /** @enum {string} */
            kind: "distance";
            /**
             * Format: double
             * @description Largest error of an answer; more than 0.
             */
            tolerance: number;
        } | {
            /**
             * Format: double
             * @description The distance; 0 asks whether the surfaces meet.
             */
            clearance: number;
            /** @enum {string} */
            kind: "clearance";
        };
        /** @description A request for advice. */
        AdviceSpec: {
            /** @description Object A. */
            object_a: string;
            /** @description Object B; absent: the same as A. */
            object_b?: string | null;
            /** @description What is asked of every configuration. */
            question: components["schemas"]["Asked"];
        };
        /**
         * @description What a model consists of.
         * @enum {string}
         */
        AdviceUnit: "triangles" | "spheres" | "voxels";
        /** @description How many of some answers agree with exact arithmetic. */
        Agreement: {
            /**
             * Format: int32
             * @description Those that say what exact arithmetic says.
             */
            agree: number;
            /**
             * Format: int32
             * @description Answers.
             */
            n: number;
        };
        /** @description One algorithm of one plugin. */
        AlgorithmInfo: {
            /** @description Authors. */
            authors: string;
            /** @description How its code was compiled: the plugin file, then the libraries that it brings. Empty when an older version looked. */
            builds?: components["schemas"]["BuildInfo"][];
            /** @description It uses earlier answers: the order of the configurations matters to it. */
            coherent: boolean;
            /** @description It reports BV and primitive tests. */
            counters: boolean;
            /** @description Unique id, e.g. `box-tree`; in a result with the settings that were chosen, `box-tree:leaf_size=4`. */
            id: string;
            /** @description SPDX licence expression. */
            license: string;
            /** @description Display name. */
            name: string;
            /** @description The paper the method comes from. */
            paper: string;
            /** @description Its parameters; a value is chosen behind the id, as in `box-tree:leaf_size=4`. */
            parameters: components["schemas"]["ParameterInfo"][];
            /** @description SHA-256 (hex) of the plugin file. */
            plugin_sha256: string;
            /** @description The questions it answers. */
            queries: components["schemas"]["Query"][];
            /** @description It computes in f32: its answers are judged in the wider band. */
            single_precision: boolean;
            /** @description It also answers for solid bodies, where an object inside another one collides. */
            solid: boolean;
            /** @description It can use several CPUs: `threads=2` behind its id enters the multi-threaded track. */
            threads: boolean;
            /** @description Home page or source. */
            url: string;
            /** @description It is measured when no algorithm is named. */
            usual: boolean;
            /** @description Version as the plugin says it. */
            version: string;
            /** @description It reports witness points. */
            witness_points: boolean;
        };
        /** @description Numbers of one algorithm on the run's configurations. */
        AlgorithmResult: {
            /** @description Algorithm id. */
            algorithm: string;
            /** @description Stopped by the time budget before the whole set. */
            budget_limited: boolean;
            /**
             * Format: double
             * @description Time to build both structures, milliseconds, from the moment on at which the meshes could be seen: median over the
             *     processes. What a process built while it was asked is part of it.
             */
            build_ms?: number | null;
            /** @description How its code was compiled; empty in runs of older versions. */
            builds?: components["schemas"]["BuildInfo"][];
            /**
             * Format: double
             * @description Mean BV tests per query.
             */
            bv_tests_mean?: number | null;
            /** @description Time and answers in each unit of length, the unit of the files first; empty in runs of older versions. */
            by_unit?: components["schemas"]["InUnit"][];
            class?: components["schemas"]["ContractClass"] | null;
            contacts?: components["schemas"]["ContactQuality"] | null;
            controls?: components["schemas"]["Controls"] | null;
            depends_on_unit?: components["schemas"]["UnitDependence"] | null;
            /** @description The answers that are not scored, because the configuration is narrower than the precision of the algorithm. */
            grazing?: components["schemas"]["Agreement"];
            /**
             * Format: double
             * @description Time to load the plugin's file, with all that it does before it sees a mesh, milliseconds: median over the processes.
             */
            load_ms?: number | null;
            /**
             * Format: int64
             * @description Peak memory of the runner above its baseline, bytes.
             */
            memory_bytes?: number | null;
            /**
             * Format: int32
             * @description Configurations measured.
             */
            n: number;
            /** @description Display name. */
            name: string;
            /**
             * Format: int32
             * @description Configurations in the set.
             */
            of: number;
            /** @description How its runner ended. */
            outcome: components["schemas"]["OutcomeInfo"];
            /**
             * Format: double
             * @description Mean primitive tests per query.
             */
            primitive_tests_mean?: number | null;
            /**
             * Format: int32
             * @description Rank by `ratio` within its class, from 1; algorithms whose intervals overlap are tied. Absent for what failed, gave a
             *     wrong answer, was measured in the development profile, or for what `unranked` says.
             */
            rank?: number | null;
            ratio?: components["schemas"]["Estimated"] | null;
            resolution?: components["schemas"]["Resolution"] | null;
            time?: components["schemas"]["TimeSummary"] | null;
            timing?: components["schemas"]["Timing"] | null;
            unranked?: components["schemas"]["Unranked"] | null;
            /** @description All answers by verdict (`correct`, `false_negative`, `gave_up`, ...); those that do not occur are left out. */
            verdicts: components["schemas"]["VerdictCount"][];
            /**
             * Format: int32
             * @description Configurations answered wrongly at least once, in any unit. Giving up and not supporting the question are not wrong.
             */
            wrong: number;
        };
        /** @description Seconds of one algorithm. */
        AlgorithmSeconds: {
            /** @description Algorithm id. */
            algorithm: string;
            /** @description Expected to be cut by the budget. */
            budget_limited: boolean;
            /**
             * Format: double
             * @description Seconds.
             */
            seconds: number;
        };
        /** @description What is asked; lengths are shares of L, the longest side of A's bounding box. */
        Asked: {
            /** @enum {string} */
            kind: "distance";
            /**
             * Format: double
             * @description Largest error of an answer; more than 0, at most 1.
             */
            tolerance: number;
        } | {
            /**
             * Format: double
             * @description The distance; 0 asks whether the surfaces meet.
             */
            clearance: number;
            /** @enum {string} */
            kind: "clearance";
        };
        /** @description One thing that somebody did. */
        AuditEntry: {
            /** @description What, in a word. */
            action: string;
            /** @description Who: the name of an account, or `the service`. */
            actor: string;
            /**
             * Format: int64
             * @description When.
             */
            at_us: number;
            /** @description The reason given. */
            detail: string;
            /**
             * Format: int64
             * @description Position in the log, from 1.
             */
            seq: number;
            /** @description To what. */
            subject: string;
        };
        /** @description An axis. */
        Axis: {
            /** @description What it measures. */
            label: string;
            /** @description Name of the lane before the axis, for points without a value. */
            lane?: string | null;
            /** @description How numbers become places. */
            scale: components["schemas"]["Scale"];
            /** @description `ns`, `1/s`, `share`, `u S`, or a plain word. */
            unit: string;
        };
        /** @description An algorithm beside the fastest one. */
        Beside: {
            /** @description The algorithm. */
            algorithm: string;
            /** @description The fastest one of its contract class. */
            fastest: string;
            ratio?: components["schemas"]["Estimated"] | null;
            /** @description What follows. */
            standing: components["schemas"]["Standing"];
            whole?: components["schemas"]["Estimated"] | null;
        };
        /** @description Results of many runs that may be compared with one another. */
        Board: {
            /** @description Speed against accuracy. */
            chart: components["schemas"]["Chart"];
            /** @description The filters in the order in which they are applied. */
            filters: components["schemas"]["BoardFilter"][];
            /** @description What is to be seen, in one sentence. */
            finding: string;
            /**
             * Format: int32
             * @description Results before any filter.
             */
            results: number;
            /** @description One per algorithm with its settings: places first, then what has none. */
            rows: components["schemas"]["BoardRow"][];
            suite?: components["schemas"]["BoardSuite"] | null;
        };
        /** @description A filter, and what it left out. */
        BoardFilter: {
            /** @description The value in force. */
            chosen: string;
            /** @description Its name in requests. */
            name: string;
            /** @description What could be chosen, as far as the filters before it allow. */
            options: components["schemas"]["BoardOption"][];
            /**
             * Format: int32
             * @description How many results it took away.
             */
            removed: number;
        };
        /** @description A value of a filter. */
        BoardOption: {
            /**
             * Format: int32
             * @description Algorithms with a result there.
             */
            algorithms: number;
            /** @description As requests name it. */
            value: string;
            /** @description In words. */
            words: string;
        };
        /** @description One algorithm with its settings. */
        BoardRow: {
            /** @description Algorithm id, with its settings. */
            algorithm: string;
            /**
             * Format: double
             * @description Build time of both structures, milliseconds; the longest.
             */
            build_ms?: number | null;
            /** @description How its code was compiled; empty when it was measured by an older version. */
            builds: components["schemas"]["BuildInfo"][];
            /** @description Contract class, in words. */
            class: string;
            /**
             * Format: double
             * @description Worst error of a distance in roundings `u S`; absent when no distance was asked for.
             */
            distance_error?: number | null;
            /**
             * Format: double
             * @description eps*, or its bound when no error was seen.
             */
            eps?: number | null;
            /** @description `eps` is a value and no bound. */
            eps_seen: boolean;
            false_alarm_share?: components["schemas"]["Estimated"] | null;
            /**
             * Format: int64
             * @description False alarms.
             */
            false_alarms: number;
            /** @description What its hierarchy is made of. */
            family: string;
            /**
             * Format: int64
             * @description When the oldest of its measurements ended.
             */
            finished_us: number;
            /** @description Nothing else is as accurate and faster. */
            frontier: boolean;
            /** @description Hardware class. */
            hardware_class: string;
            /**
             * Format: int64
             * @description Memory in bytes; the most.
             */
            memory_bytes?: number | null;
            /**
             * Format: int64
             * @description Missed collisions.
             */
            missed: number;
            missed_share?: components["schemas"]["Estimated"] | null;
            /**
             * Format: int64
             * @description Answers judged.
             */
            n: number;
            /** @description Display name. */
            name: string;
            /**
             * Format: int32
             * @description Of so many.
             */
            of: number;
            /**
             * Format: int32
             * @description Version of the oracle that judged it.
             */
            oracle?: number | null;
            /** @description SHA-256 of the plugin file. */
            plugin_sha256: string;
            /**
             * Format: int32
             * @description Place by speed, from 1; overlapping intervals share one. Absent for what failed or answered wrongly.
             */
            rank?: number | null;
            rate?: components["schemas"]["Estimated"] | null;
            /** @description Why it has no place. */
            reason?: string | null;
            /** @description The runs behind it. */
            runs: string[];
            /**
             * Format: int32
             * @description Scenes and distances it was measured on.
             */
            scenarios: number;
            stability?: components["schemas"]["StabilityPassed"] | null;
            /** @description Shares its place. */
            tied: boolean;
            /**
             * Format: int64
             * @description Wrong answers in all.
             */
            wrong: number;
            wrong_share?: components["schemas"]["Estimated"] | null;
        };
        /** @description The part of a suite that a board shows. */
        BoardSuite: {
            /** @description The hardware class of all these results, in words. */
            hardware: string;
            /**
             * Format: int64
             * @description When the newest was.
             */
            newest_us: number;
            /**
             * Format: int64
             * @description When the oldest of these results was measured.
             */
            oldest_us: number;
            /**
             * Format: int32
             * @description Scenarios that the filters leave; who was not measured on all of them has no place.
             */
            scenarios: number;
            /** @description SHA-256 (hex) of its file. */
            sha256: string;
            /**
             * Format: int32
             * @description Its version.
             */
            version: number;
        };
        /**
         * @description How one file of an algorithm was compiled. A part of the result: the same source compiled for another processor may take half
         *     the time.
         */
        BuildInfo: {
            /** @description What the compilers wrote into it of themselves. */
            compilers: string[];
            /** @description Name of the file, without its folder. */
            file: string;
            /** @description The options that they recorded (`-frecord-gcc-switches`), those that decide what code is made; empty when they did not. */
            flags: string[];
            /** @description Extensions of x86-64 whose instructions were found in its code, e.g. `AVX2`. It may choose among them when it runs. */
            instruction_sets: string[];
        };
        /** @description A campaign, and how far it is. */
        CampaignInfo: {
            /** @description Name of the account that made it, or `the operator`. */
            created_by: string;
            /**
             * Format: int64
             * @description When it was made.
             */
            created_us: number;
            /**
             * Format: int64
             * @description When its last run ended.
             */
            ended_us?: number | null;
            /** @description The hardware class that it measures on. */
            hardware_class: string;
            /** @description Its id. */
            id: string;
            /**
             * Format: int32
             * @description Version of the oracle that judges.
             */
            oracle: number;
            /** @description It measures public runs again. */
            people: boolean;
            /** @description Why it was made. */
            reason: string;
            /** @description Old and new results side by side, as far as the viewer may see them; empty in lists. */
            results: components["schemas"]["Compared"][];
            /** @description Its runs by state. */
            runs: components["schemas"]["CampaignRuns"];
            /** @description Running until nothing of it waits any more; then done, or cancelled. */
            state: components["schemas"]["State"];
            /** @description It measures the suite. */
            suite: boolean;
            /** @description SHA-256 (hex) of the suite's file. */
            suite_sha256: string;
            /**
             * Format: int32
             * @description Version of the suite.
             */
            suite_version: number;
        };
        /** @description What a campaign would queue now. */
        CampaignPreview: {
            /**
             * Format: double
             * @description How long measuring all of it is expected to take, in seconds.
             */
            expected_seconds: number;
            /** @description The hardware class of this machine. */
            hardware_class: string;
            /**
             * Format: int32
             * @description Version of the oracle that judges.
             */
            oracle: number;
            /**
             * Format: int32
             * @description Public runs of people.
             */
            peoples_runs: number;
            /**
             * Format: int32
             * @description Of these, runs that repeat one which was measured before.
             */
            suite_repeats: number;
            /**
             * Format: int32
             * @description Runs of the suite.
             */
            suite_runs: number;
            /**
             * Format: int32
             * @description Version of the suite.
             */
            suite_version: number;
        };
        /**
         * @description A campaign that is asked for.
         * @example {
         *       "people": true,
         *       "reason": "A new machine; the old hardware class was retired.",
         *       "suite": true
         *     }
         */
        CampaignRequest: {
            /**
             * @description Measure public runs again whose accounts agree to that.
             * @default true
             */
            people: boolean;
            /** @description Why, for everybody to read. */
            reason: string;
            /**
             * @description Measure the suite as far as it was not measured on this hardware class and by this oracle.
             * @default true
             */
            suite: boolean;
        };
        /** @description The runs of a campaign by state. */
        CampaignRuns: {
            /**
             * Format: int32
             * @description Ended by somebody.
             */
            cancelled: number;
            /**
             * Format: int32
             * @description With results.
             */
            done: number;
            /**
             * Format: double
             * @description How long those in the queue and at work are expected to take together, in seconds.
             */
            expected_seconds: number;
            /**
             * Format: int32
             * @description Ended by a fault.
             */
            failed: number;
            /**
             * Format: int32
             * @description At work.
             */
            running: number;
            /**
             * Format: int32
             * @description In the queue.
             */
            waiting: number;
        };
        /**
         * @description How a cell of the table looks: the gravest of what is in it.
         * @enum {string}
         */
        CellState: "agrees" | "slow" | "wrong" | "broken" | "unsupported" | "refused";
        /** @description A picture of numbers. */
        Chart: {
            /** @description What is to be seen, in one sentence; empty when there is nothing to say. */
            finding: string;
            /** @description Which one, as requests name it. */
            kind: string;
            /** @description How to read it, one sentence each. */
            notes: string[];
            /** @description What is drawn, in the order of the key. */
            series: components["schemas"]["Series"][];
            /** @description What is shown. */
            title: string;
            /** @description To the right. */
            x: components["schemas"]["Axis"];
            /** @description Upwards. */
            y: components["schemas"]["Axis"];
        };
        /**
         * @description What a chart of a run shows.
         * @enum {string}
         */
        ChartKind: "accuracy" | "distance" | "triangles" | "ecdf" | "bv_tests" | "primitive_tests" | "resolution";
        /** @description One check of a plugin. */
        CheckLine: {
            /** @description What was checked, e.g. `load in the jail`. */
            check: string;
            /** @description What was seen, one sentence. */
            evidence: string;
            /** @description How to mend it, when it did not pass. */
            hint?: string | null;
            repro?: components["schemas"]["Repro"] | null;
            /** @description How it ended. */
            verdict: components["schemas"]["CheckVerdict"];
        };
        /**
         * @description How one check ended.
         * @enum {string}
         */
        CheckVerdict: "pass" | "note" | "fail";
        /**
         * @description What an account has chosen. All of it is off until somebody says otherwise.
         * @example {
         *       "address": "ada@example.org",
         *       "agrees_to_reruns": true,
         *       "confirmed": true,
         *       "mail_notices": true,
         *       "mailing": true
         *     }
         */
        Choices: {
            /** @description Where mails go. Only the account itself sees it. */
            address?: string | null;
            /** @description The service may measure this account's public runs again on new hardware, and tells it so. */
            agrees_to_reruns: boolean;
            /** @description The link that was sent to the address has been opened. */
            confirmed: boolean;
            /** @description Notices come by mail, too, once the address is confirmed. */
            mail_notices: boolean;
            /** @description This service sends mails at all. */
            mailing: boolean;
        };
        /** @description The stable link of a run or a plugin, and how it is cited. */
        Citation: {
            /** @description An entry for BibTeX. */
            bibtex: string;
            /** @description A CITATION.cff, version 1.2.0. */
            cff: string;
            /**
             * @description Where it is found as long as it is kept.
             * @example https://bench.example/r/0193f1a0-0000-7000-8000-000000000000
             */
            link: string;
        };
        /** @description What an answer says to be where two objects meet, or are nearest. */
        Claim: {
            /** @description Points in the world, on A and on B. */
            points?: number[][] | null;
            /** @description Triangles of A and B. */
            triangles?: number[] | null;
        };
        /**
         * @description What may be asked of an answer at one precision: `CLEAR` and `COLLIDING` are scored, `GRAZING` is reported only.
         * @enum {string}
         */
        Class: "clear" | "colliding" | "grazing";
        /** @description How many configurations are of a class. */
        ClassCount: {
            /** @description The class. */
            class: components["schemas"]["Class"];
            /**
             * Format: int32
             * @description How many.
             */
            count: number;
        };
        /** @description One algorithm in one scenario, before and in a campaign. */
        Compared: {
            /** @description Algorithm id, with its settings. */
            algorithm: string;
            /** @description How far apart. */
            distance: string;
            /** @description Display name. */
            name: string;
            new?: components["schemas"]["ComparedResult"] | null;
            /** @description It belongs to the suite. */
            of_suite: boolean;
            old?: components["schemas"]["ComparedResult"] | null;
            /** @description The question, in words. */
            question: string;
            ratio?: components["schemas"]["Estimated"] | null;
            /** @description The run of the campaign. */
            run: string;
            /** @description Both are of the same plugin file. */
            same_file: boolean;
            /** @description The pair of objects. */
            scene: string;
            /** @description Where that is. */
            state: components["schemas"]["State"];
        };
        /** @description One side of a comparison. */
        ComparedResult: {
            /** @description CPU model. */
            cpu: string;
            /**
             * Format: int64
             * @description When that ended.
             */
            finished_us: number;
            /** @description Hardware class. */
            hardware_class: string;
            median_ns?: components["schemas"]["Estimated"] | null;
            /**
             * Format: int32
             * @description Configurations measured.
             */
            n: number;
            /**
             * Format: int32
             * @description Version of the oracle; absent in runs of older versions.
             */
            oracle?: number | null;
            /** @description How it ended. */
            outcome: components["schemas"]["OutcomeName"];
            /** @description SHA-256 (hex) of the plugin file. */
            plugin_sha256: string;
            /** @description The run. */
            run: string;
            /** @description Version of the program that measured. */
            version: string;
            /**
             * Format: int32
             * @description Wrong answers.
             */
            wrong: number;
        };
        /** @description Lists of contacts against the complete ones, all configurations together. Pairs within the precision band are free. */
        ContactQuality: {
            /**
             * Format: int64
             * @description Pairs listed.
             */
            listed: number;
            /**
             * Format: double
             * @description Share of the listed pairs that meet or are within tau of it; absent when nothing was listed.
             */
            precision?: number | null;
            /**
             * Format: double
             * @description Share of the pairs crossing by more than tau that were listed, over the lists that fit the host's buffer; absent
             *     when there is no such pair.
             */
            recall?: number | null;
            /**
             * Format: int64
             * @description Such pairs.
             */
            robust: number;
        };
        /** @description The contract class of a result. Places are given within one class, never across. */
        ContractClass: {
            /**
             * Format: int32
             * @description Bits of the arithmetic that it declares, 32 or 64; its answers are judged accordingly.
             */
            bits: number;
            /**
             * Format: int32
             * @description CPUs that it might use; 1 is the single-threaded track, which the jail enforces.
             */
            cpus: number;
            /** @description What was delivered. */
            delivered: components["schemas"]["Delivered"];
            /** @description In which order it was asked. */
            order: components["schemas"]["Order"];
        };
        /**
         * @description What an algorithm made of the control questions: questions like the set's, drawn from the run's seed and mixed into its
         *     order, so that the set's answer cannot be guessed. They are in no record, time or count of verdicts.
         */
        Controls: {
            /**
             * Format: int32
             * @description Of the answered, those that collide.
             */
            crossing: number;
            /**
             * Format: double
             * @description Probability, at most, that a plugin that guesses half of its answers gives no wrong one to these.
             */
            guess: number;
            /**
             * Format: int32
             * @description Answered.
             */
            n: number;
            /**
             * Format: int32
             * @description Drawn for the run.
             */
            of: number;
            /**
             * Format: int32
             * @description Not answered although asked.
             */
            silent: number;
            /**
             * Format: int32
             * @description Answered wrongly in at least one process.
             */
            wrong: number;
        };
        /** @description Name and password. */
        Credentials: {
            /** @description Moves the guest's runs and objects into the account. */
            keep?: boolean;
            /** @description User name or e-mail address: 3 to 80 letters, digits and `. _ - @ +`. */
            name: string;
            /** @description Password of 10 to 200 characters. */
            password: string;
        };
        /** @description Configurations whose distance or margin, divided by S, is from `10^exponent` to ten times that. */
        Decade: {
            /**
             * Format: int32
             * @description Which power of ten.
             */
            exponent: number;
            /**
             * Format: int32
             * @description Configurations that were answered.
             */
            n: number;
            /**
             * Format: int32
             * @description Those answered wrongly, however narrow the decision.
             */
            wrong: number;
        };
        /** @description A step, and why it is taken. */
        Decision: {
            /** @description The step. */
            action: components["schemas"]["Action"];
            /** @description Why, for the author and for the log. */
            reason?: string;
        };
        /**
         * @description Deleting one's account.
         * @example {
         *       "password": "correct horse battery staple"
         *     }
         */
        DeleteAccount: {
            /** @description The password, once more. */
            password: string;
        };
        /**
         * @description What becomes of an account's things when it is deleted.
         * @example {
         *       "blocked_by": null,
         *       "bytes": 7340032,
         *       "goes": {
         *         "advice": 1,
         *         "objects": 3,
         *         "plugins": 1,
         *         "runs": 12
         *       },
         *       "stays": {
         *         "advice": 0,
         *         "objects": 1,
         *         "plugins": 1,
         *         "runs": 2
         *       }
         *     }
         */
        DeletionPreview: {
            /** @description Why the account cannot be deleted now, and how to mend that. */
            blocked_by?: string | null;
            /**
             * Format: int64
             * @description Bytes of the stored files that go: those that nobody else uses.
             */
            bytes: number;
            /** @description What is not public is deleted, with everything that the account was told and has chosen. */
            goes: components["schemas"]["OwnedCounts"];
            /** @description What is public stays, because it is cited, and belongs to a former account without a name. A plugin stays once it was public. */
            stays: components["schemas"]["OwnedCounts"];
        };
        /**
         * @description What an algorithm delivered, as its answers show.
         * @enum {string}
         */
        Delivered: "first_contact" | "all_contacts" | "distance" | "distance_with_witness";
        /** @description Why somebody wants to be a developer. */
        DeveloperRequest: {
            /** @description A sentence or two for the curators. */
            reason: string;
        };
        /** @description The worst errors of distances. */
        DistanceError: {
            /**
             * Format: int32
             * @description Distances that are numbers.
             */
            n: number;
            /**
             * Format: double
             * @description The most above the certified interval, in units of `u S`; absent when none is above it.
             */
            over?: number | null;
            /**
             * Format: double
             * @description The most below it; absent when none is.
             */
            under?: number | null;
        };
        /**
         * @description Where the seed of a run comes from. A drawn one is the first 53 bits of SHA-256 over the text `secret`, followed by the
         *     SHA-256 of the configuration set and of every plugin file in the run's order; `commitment` is the SHA-256 of `secret`
         *     and was published when the run was asked for, before anything was measured. A run of the public suite draws its configurations,
         *     too: their seed is the same with the word `configurations` in place of the configuration set's hash.
         */
        Draw: {
            /** @description What was published before. */
            commitment?: string | null;
            /** @description Revealed with the result; absent when whoever asked for the run chose the seed. */
            secret?: string | null;
            /**
             * Format: int64
             * @description The seed.
             */
            seed: number;
        };
        /** @description Empirical distribution of the time per query. */
        Ecdf: {
            /** @description Algorithm id. */
            algorithm: string;
            /**
             * Format: int32
             * @description Number of values.
             */
            n: number;
            /** @description Share of queries at most that long, 0 to 1. */
            share: number[];
            /** @description Times in nanoseconds, ascending, at most 512 points. */
            time_ns: number[];
        };
        /** @description The facts of the machine and of the clock, attached to each run. */
        Environment: {
            calibration_ns?: components["schemas"]["Estimated"] | null;
            /** @description `spin` or `futex`. */
            clock: string;
            /**
             * Format: double
             * @description Relative change of the clock's rate against the kernel's clock from the start of the program to the end of the run; a few
             *     millionths are measurement error. Absent in results of older versions.
             */
            clock_drift?: number | null;
            /** @description CPU model. */
            cpu: string;
            /**
             * Format: int32
             * @description CPUs.
             */
            cpus: number;
            /**
             * Format: int64
             * @description Times that are longer than the plugin took, because the supervisor was kept from looking; they count only where a
             *     question has no other.
             */
            disturbed: number;
            draw?: components["schemas"]["Draw"] | null;
            /** @description Hash over what makes times comparable. */
            hardware_class: string;
            /** @description Layers of the jail in force. */
            jail: string[];
            /** @description Kernel release. */
            kernel: string;
            /**
             * Format: int64
             * @description Memory in bytes.
             */
            memory_bytes: number;
            /** @description Null round trip that is subtracted: median, with p05 and p95 as its interval, nanoseconds. */
            null_ns: components["schemas"]["Estimated"];
            /** @description `production`, or `dev`: foreign plugins then ran with what layers the machine had, and nothing of it is ranked. */
            profile?: string;
            reference?: components["schemas"]["Reference"] | null;
            /** @description Version of this program. */
            version: string;
        };
        /** @description What a run would cost. */
        Estimate: {
            /**
             * Format: double
             * @description Expected seconds to find and certify the configurations.
             */
            configuration_seconds: number;
            /**
             * Format: int64
             * @description Number of configurations.
             */
            configurations: number;
            /** @description The set is stored already. */
            configurations_stored: boolean;
            /** @description Expected seconds per algorithm that was asked for. */
            measuring_seconds: components["schemas"]["AlgorithmSeconds"][];
            /**
             * @description Why whoever asks may not start it, and what to change; absent when they may. A part of it, such as a quick look, may be
             *     allowed.
             */
            refused?: string | null;
            /**
             * Format: int32
             * @description Runs ahead in the queue.
             */
            runs_ahead: number;
            /**
             * Format: double
             * @description All together, with the reference algorithm where nobody asked for it, without waiting.
             */
            total_seconds: number;
            /**
             * Format: double
             * @description Expected seconds until those are done.
             */
            wait_seconds: number;
        };
        /** @description A statistic with its 95 % bootstrap interval. */
        Estimated: {
            /**
             * Format: double
             * @description Upper end.
             */
            hi: number;
            /**
             * Format: double
             * @description Lower end.
             */
            lo: number;
            /**
             * Format: double
             * @description The value.
             */
            value: number;
        };
        /** @description A question that fails, complete. */
        FailingCase: {
            /** @description Object A as OBJ. */
            a: string;
            /**
             * Format: double
             * @description The value of the parameter.
             */
            at: number;
            /** @description Object B as OBJ. */
            b: string;
            /** @description The command line that asks it again. */
            command: string;
            /** @description What is true. */
            expected: string;
            /** @description What was answered. */
            got: string;
            /** @description Pose of A, row-major 4x4; NaN and infinity as words. */
            pose_a: string[];
            /** @description Pose of B. */
            pose_b: string[];
            /**
             * Format: int32
             * @description The seed.
             */
            seed: number;
            /** @description Triangles of A and B now. */
            triangles: number[];
            /** @description Triangles of A and B before they were made fewer. */
            triangles_before: number[];
        };
        /** @description A failure that somebody reported. */
        FailureInfo: {
            /** @description Short name. */
            id: string;
            /** @description The numbers are the report's own, and not made after its description. */
            numbers_reported: boolean;
            /** @description What was seen there. */
            seen: string;
            /** @description Where it was reported. */
            source: string;
            /** @description Address of the report. */
            url: string;
        };
        /** @description One method on one reported failure. */
        FailureResult: {
            /** @description What is true. */
            expected: string;
            /** @description What was answered. */
            got: string;
            /** @description The reported failure. */
            id: string;
            /** @description How it went. */
            state: components["schemas"]["CellState"];
        };
        /** @description A family of hard questions. */
        FamilyInfo: {
            /** @description It asks for more than the interface promises to plugins: wrong answers are shown and are no fault. */
            beyond: boolean;
            /** @description Between two steps the threshold is narrowed by bisection. */
            continuous: boolean;
            /** @description Short name, as on the command line. */
            id: string;
            /** @description Name. */
            name: string;
            /** @description What is swept, with its unit. */
            parameter: string;
            /** @description What it tests. */
            sentence: string;
            /** @description Where such failures were seen. */
            source: string;
        };
        /** @description One method on one family. */
        FamilyResult: {
            /** @description The family. */
            family: string;
            first?: components["schemas"]["FailingCase"] | null;
            /** @description The gravest of what was seen. */
            state: components["schemas"]["CellState"];
            /** @description Step by step, ascending. */
            steps: components["schemas"]["StepResult"][];
            /** @description All steps together. */
            tally: components["schemas"]["Tally"];
            /** @description Where it starts to fail: one for each side on which it does. */
            thresholds: components["schemas"]["ThresholdInfo"][];
        };
        /**
         * @description How a series is drawn.
         * @enum {string}
         */
        Form: "line" | "steps" | "rule";
        /** @description Values on the vertices of an object. */
        Heatmap: {
            /** @description Values that went into each vertex after outlier removal. */
            counts: number[];
            /** @description Values that outlier removal took from each vertex. */
            dropped: number[];
            /**
             * Format: int32
             * @description Configurations that went in; of a difference, those of the map that has fewer.
             */
            n: number;
            /** @description Smallest and largest value; absent when no vertex has one. */
            range?: number[] | null;
            /** @description What is shown: what was asked, but for what the measure leaves no choice of. */
            request: components["schemas"]["HeatmapRequest"];
            /** @description Unit of the values (`ns`, `tests`, `configurations`, `share`, `u S`). */
            unit: string;
            /** @description One per vertex, in the object's vertex order; null where there is none. */
            values: (number | null)[];
        };
        /** @description Which map; the query string of every heatmap route. */
        HeatmapRequest: {
            /** @description Show the difference to this algorithm: the values of `algorithm` minus its values. */
            against?: string | null;
            /** @description Subtract the values of another run on the same object; of the same algorithm unless `against` names another one. */
            against_run?: string | null;
            /** @description Algorithm id (ignored for density). */
            algorithm: string;
            /** @description What to show. */
            measure: components["schemas"]["Measure"];
            /** @description What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped. */
            outliers?: components["schemas"]["Outliers"];
            /** @description Which object. */
            side?: components["schemas"]["Side"];
            /** @description Which statistic. */
            statistic: components["schemas"]["Statistic"];
            /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
            where?: string | null;
        };
        /** @description Fresh configurations, compared with the oracle. */
        HeldOut: {
            /** @description Configurations for which the whole objects had to be asked. */
            falls_back: components["schemas"]["Share"];
            /**
             * Format: double
             * @description The largest difference to the oracle's distance, where a distance was asked.
             */
            observed_error?: number | null;
            /** @description Intervals or answers of the levels themselves that contradict the oracle. */
            violations: components["schemas"]["Share"];
            /** @description Wrong answers of the advice as a whole. */
            wrong: components["schemas"]["Share"];
        };
        /** @description Who asks: a guest has no account. */
        Identity: {
            account?: components["schemas"]["AccountInfo"] | null;
        };
        /**
         * @description Time and answers in one unit. The rank comes from the unit of the files alone, except that a wrong answer in any unit
         *     takes it away.
         */
        InUnit: {
            /**
             * Format: int32
             * @description Answers, control questions not included. A configuration may have several.
             */
            answers: number;
            /**
             * Format: int32
             * @description All coordinates were multiplied by two to this power, which rounds nothing; 0 is the unit of the files.
             */
            exponent: number;
            mean_ns?: components["schemas"]["Estimated"] | null;
            /**
             * Format: int32
             * @description Wrong ones that miss a collision.
             */
            missed: number;
            /**
             * Format: int32
             * @description Configurations that were timed in it.
             */
            n: number;
            pace?: components["schemas"]["Estimated"] | null;
            /**
             * Format: int32
             * @description Fresh processes that were timed in this unit.
             */
            processes: number;
            /**
             * Format: int32
             * @description Wrong ones of them.
             */
            wrong: number;
        };
        /** @description An invitation, as curators see it. */
        InvitationInfo: {
            /** @description Name of the account that accepted it. */
            accepted_by?: string | null;
            /**
             * Format: int64
             * @description When it was made.
             */
            created_us: number;
            /**
             * Format: int64
             * @description Until when it can be accepted.
             */
            expires_us: number;
            /** @description Its id. */
            id: string;
            /** @description Name of the account that made it; absent when whoever has the data folder did. */
            invited_by?: string | null;
            /** @description For whom it is, in the words of who made it. */
            recipient: string;
            /** @description Where it stands. */
            state: components["schemas"]["InvitationState"];
        };
        /** @description An invitation that is asked for. */
        InvitationRequest: {
            /**
             * Format: int32
             * @description Days until it expires, 1 to 90.
             * @default 14
             */
            days: number;
            /** @description For whom it is: 1 to 200 characters, for curators and the log. */
            recipient: string;
        };
        /**
         * @description Where an invitation stands.
         * @enum {string}
         */
        InvitationState: "open" | "accepted" | "revoked" | "expired";
        /** @description One level of one object. */
        LevelFacts: {
            /**
             * Format: double
             * @description The largest deviation.
             */
            deviation: number;
            /**
             * Format: double
             * @description The largest thickness; 0 of the object.
             */
            thickness: number;
            /**
             * Format: int32
             * @description Its triangles.
             */
            triangles: number;
        };
        /** @description What a developer says of a plugin. */
        Manifest: {
            /** @description Authors. */
            authors: string;
            /** @description SPDX licence expression. */
            license: string;
            /** @description Display name. */
            name: string;
            /** @description The paper the method comes from. */
            paper?: string;
            /** @description The questions it answers. */
            queries: components["schemas"]["Query"][];
            /** @description Where the source is. */
            source?: string;
            /** @description It enters the multi-threaded track, too. */
            threads?: boolean;
            /** @description Version: letters, digits and `. + - _`, at most 32; another one for every upload. */
            version: string;
        };
        /**
         * @description What to colour an object by.
         * @enum {string}
         */
        Measure: "time" | "bv_tests" | "primitive_tests" | "density" | "wrong" | "missed" | "false_alarms" | "distance_error" | "flips" | "disagreement";
        /** @description A number with its 95 % interval. */
        Measured: {
            /**
             * Format: double
             * @description Upper end.
             */
            hi: number;
            /**
             * Format: double
             * @description Lower end.
             */
            lo: number;
            /**
             * Format: double
             * @description The number.
             */
            value: number;
        };
        /** @description All pairs of triangles that meet in one configuration. */
        Meeting: {
            /**
             * Format: int32
             * @description Index of the configuration in the set.
             */
            configuration: number;
            /** @description The pairs (triangle of A, triangle of B), at most 100,000. */
            pairs: number[][];
            /**
             * Format: int32
             * @description Pairs that meet.
             */
            total: number;
        };
        /** @description How the configurations of a set were found. */
        Method: {
            /** @enum {string} */
            kind: "sphere";
            /** @description How directions and rotations are chosen. */
            sampling: components["schemas"]["Sampling"];
            /**
             * Format: int64
             * @description Seed of the low-discrepancy sequences.
             */
            seed?: number;
        } | {
            /** @enum {string} */
            kind: "grid";
            /** @description How rotations and the grid's spacing are chosen. */
            sampling: components["schemas"]["Sampling"];
            /**
             * Format: int64
             * @description Seed of the low-discrepancy sequences.
             */
            seed?: number;
        } | {
            /**
             * Format: double
             * @description Distance of the bounding boxes' centres divided by L.
             */
            center_distance: number;
            /**
             * Format: int32
             * @description Number of frames of the full turn.
             */
            count?: number;
            /** @enum {string} */
            kind: "trajectory";
        } | {
            /**
             * Format: int32
             * @description Number of poses.
             */
            count: number;
            /**
             * Format: double
             * @description Share of poses that collide; the cube is chosen for it.
             */
            hit_share: number;
            /** @enum {string} */
            kind: "random";
            /**
             * Format: int64
             * @description Seed of the low-discrepancy sequence.
             */
            seed?: number;
        } | {
            /** @enum {string} */
            kind: "file";
            /** @description Content hash (SHA-256, hex) of the file. */
            sha256: string;
        };
        /**
         * @description An address that mails are to go to.
         * @example {
         *       "address": "ada@example.org"
         *     }
         */
        NewAddress: {
            /** @description At most 254 plain letters, digits and signs. */
            address: string;
        };
        /**
         * @description Choices to change; what is absent stays as it is.
         * @example {
         *       "mail_notices": true
         *     }
         */
        NewChoices: {
            /** @description May public runs be measured again on new hardware? */
            agrees_to_reruns?: boolean | null;
            /** @description Do notices come by mail, too? */
            mail_notices?: boolean | null;
        };
        /** @description An invitation just made: the only time that its secret is shown. */
        NewInvitation: {
            /** @description The invitation. */
            invitation: components["schemas"]["InvitationInfo"];
            /** @description The page that accepts it. The secret stands behind `#`, so that no server and no log hears of it. */
            link: string;
            /** @description What is shown to accept it. */
            secret: string;
        };
        /** @description A change of the password. */
        NewPassword: {
            /** @description The password from now on. */
            new: string;
            /** @description The password until now. */
            old: string;
        };
        /** @description Another role for an account. */
        NewRole: {
            /** @description The role. */
            role: components["schemas"]["Role"];
        };
        /** @description A token just made: the only time that its secret is shown. */
        NewToken: {
            /** @description To be sent as `Authorization: Bearer <secret>`. */
            secret: string;
            /** @description The token. */
            token: components["schemas"]["TokenInfo"];
        };
        /** @description Who is to see it. */
        NewVisibility: {
            /** @description From now on. */
            visibility: components["schemas"]["Visibility"];
        };
        /**
         * @description Something that the service tells an account.
         * @example {
         *       "created_us": 1793000000000000,
         *       "id": "0199f3a2-7c1e-7d40-9a55-0d6c2f1b8e11",
         *       "link": "/p/0199f3a0-11aa-7c02-b1d4-5a0f9be2c377",
         *       "read_us": null,
         *       "subject": "Your plugin Gauss map 1.2.0 is public",
         *       "text": "A curator approved it. Anyone may benchmark it now."
         *     }
         */
        NoticeInfo: {
            /**
             * Format: int64
             * @description When it was written.
             */
            created_us: number;
            /** @description Its id. */
            id: string;
            /** @description The page to look at: a path within the service. */
            link: string;
            /**
             * Format: int64
             * @description When its account marked it as read.
             */
            read_us?: number | null;
            /** @description What it is about, in one line. */
            subject: string;
            /** @description What there is to know. */
            text: string;
        };
        /** @description An object as the lists show it. */
        ObjectInfo: {
            /** @description Axis-aligned bounding box: minimum x y z, maximum x y z. */
            bounds: number[];
            /** @description Every edge has exactly two triangles. */
            closed: boolean;
            /**
             * Format: int64
             * @description When it was added.
             */
            created_us: number;
            /** @description Stable id: `stock:<name>` for stock objects, otherwise a UUID. */
            id: string;
            /** @description Added by the caller, who decides who sees it. */
            mine: boolean;
            /** @description Display name. */
            name: string;
            /** @description SHA-256 (hex) of the mesh (positions, then triangles, little-endian). */
            sha256: string;
            /** @description Ships with the service. */
            stock: boolean;
            /** @description Where it comes from and under which terms. */
            terms: string;
            /**
             * Format: int32
             * @description Triangle count.
             */
            triangles: number;
            /**
             * Format: int32
             * @description Vertex count.
             */
            vertices: number;
            /** @description Who sees it. */
            visibility: components["schemas"]["Visibility"];
            /** @description What was noticed and mended while reading (one sentence each). */
            warnings: string[];
        };
        /**
         * @description What was in the link that confirms an address.
         * @example {
         *       "secret": "5d0c4b7e9f1a4c6e8b3d2f1a0c9e8d7b6a5f4e3d2c1b40a98f7e6d5c4b3a2918"
         *     }
         */
        OpenedLink: {
            /** @description The secret. */
            secret: string;
        };
        /**
         * @description In which order configurations come.
         * @enum {string}
         */
        Order: "shuffled" | "trajectory";
        /** @description How a runner ended. */
        OutcomeInfo: {
            /** @description One sentence, for people: nothing is decided by it. */
            message: string;
            /** @description Which outcome. */
            name: components["schemas"]["OutcomeName"];
            /** @description Our fault, never the plugin's. */
            ours: boolean;
            /**
             * Format: int32
             * @description Number of the signal that ended it; absent otherwise, and in runs of older versions.
             */
            signal?: number | null;
        };
        /**
         * @description The outcomes of the glossary.
         * @enum {string}
         */
        OutcomeName: "Completed" | "OutOfBudget" | "NotMeasured" | "Failed" | "LoadError" | "FileReplaced" | "Signaled" | "TimedOut" | "OutOfMemory" | "OutputLimit" | "SyscallDenied" | "ProtocolViolation" | "TimingIntegrity" | "Cancelled" | "SandboxFault";
        /**
         * @description What happens to outliers: values outside Q1 - 1.5 IQR .. Q3 + 1.5 IQR.
         * @enum {string}
         */
        Outliers: "keep" | "per_vertex" | "global";
        /** @description How many of each. */
        OwnedCounts: {
            /**
             * Format: int32
             * @description Pieces of advice.
             */
            advice: number;
            /**
             * Format: int32
             * @description Objects.
             */
            objects: number;
            /**
             * Format: int32
             * @description Plugins, each version by itself.
             */
            plugins: number;
            /**
             * Format: int32
             * @description Runs with their results.
             */
            runs: number;
        };
        /** @description A run or an object, as lists call it. */
        OwnedItem: {
            /** @description Its id. */
            id: string;
            /** @description Its name; of a run, those of its objects. */
            name: string;
        };
        /** @description Runs, objects and advice of one owner: all of them, or those that go with one of them. */
        OwnedItems: {
            /**
             * Format: int32
             * @description How many pieces of advice.
             */
            advice: number;
            /**
             * Format: int64
             * @description Bytes of the stored files that go with them: those that nobody else uses.
             */
            bytes: number;
            /**
             * Format: int64
             * @description When a guest's things go by themselves; absent for accounts, whose things stay.
             */
            kept_until_us?: number | null;
            /** @description Objects, newest first. */
            objects: components["schemas"]["OwnedItem"][];
            /** @description Runs with their results, newest first. */
            runs: components["schemas"]["OwnedItem"][];
        };
        /** @description A knob of an algorithm. */
        ParameterInfo: {
            /**
             * Format: double
             * @description Value when nothing is said.
             */
            default: number;
            /** @description What it does. */
            description: string;
            /** @description Only whole numbers. */
            integer: boolean;
            /**
             * Format: double
             * @description Largest value.
             */
            maximum: number;
            /**
             * Format: double
             * @description Smallest value.
             */
            minimum: number;
            /** @description Name. */
            name: string;
        };
        /** @description A plugin somebody brought, as whoever may see it sees it. */
        PluginInfo: {
            /** @description The algorithms that it describes. */
            algorithms: components["schemas"]["AlgorithmInfo"][];
            /**
             * Format: int64
             * @description Size of the file.
             */
            bytes: number;
            /**
             * Format: int64
             * @description When its state changed last.
             */
            changed_us: number;
            /**
             * Format: int64
             * @description When it was sent.
             */
            created_us: number;
            /** @description The hardware class on which it was taken out, where that is not the one of its check. */
            excluded_on?: string | null;
            /** @description Name of the file as it was sent. */
            file: string;
            /** @description What a curator should look at; for curators and the author. */
            flags: string[];
            /** @description The hardware class on which it was checked. */
            hardware_class?: string | null;
            /** @description What was done to it, oldest first. */
            history: components["schemas"]["AuditEntry"][];
            /** @description Its id. */
            id: string;
            /** @description The report so far. */
            lines: components["schemas"]["CheckLine"][];
            /** @description What its author says of it. */
            manifest: components["schemas"]["Manifest"];
            /** @description The viewer sent it. */
            mine: boolean;
            /** @description Name of the account that sent it. */
            owner: string;
            /** @description The version before this one that is or was public. */
            previous?: string | null;
            /** @description Why it is there: a curator's or the author's words, or the first line that failed. */
            reason: string;
            /** @description SHA-256 (hex) of the file. */
            sha256: string;
            /** @description The registered key of its author that it is signed with, as minisign writes it. */
            signed_by?: string | null;
            /** @description Where it is on its way. */
            state: components["schemas"]["PluginState"];
        };
        /**
         * @description Where a plugin is on its way to the public benchmark.
         * @enum {string}
         */
        PluginState: "uploaded" | "vetted" | "failed" | "validated" | "awaiting" | "asked" | "rejected" | "public" | "suspended" | "excluded" | "withdrawn";
        /** @description One value, with what is known of it. */
        Point: {
            /** @description `x` may well be more. */
            at_least: boolean;
            /**
             * Format: int64
             * @description False alarms among them; said in amber.
             */
            false_alarms: number;
            /** @description Drawn filled; hollow otherwise. */
            filled: boolean;
            /**
             * Format: int64
             * @description Collisions missed among them; said in red.
             */
            missed: number;
            /**
             * Format: int64
             * @description How many measured values are behind it.
             */
            n: number;
            /** @description Name beside the mark. */
            name?: string | null;
            /** @description Everything in one sentence; empty where name and numbers say it. */
            words: string;
            /**
             * Format: double
             * @description Along the first axis; absent: in the lane.
             */
            x?: number | null;
            /**
             * Format: double
             * @description Upper end; of a point in the lane: the bound at 95 %.
             */
            x_hi?: number | null;
            /**
             * Format: double
             * @description Lower end of its 95 % interval.
             */
            x_lo?: number | null;
            /**
             * Format: double
             * @description Along the second axis.
             */
            y: number;
            /**
             * Format: double
             * @description Upper end.
             */
            y_hi?: number | null;
            /**
             * Format: double
             * @description Lower end of its 95 % interval.
             */
            y_lo?: number | null;
        };
        /**
         * @description A run that measured a part of its configurations, evenly spread over all. Its wrong answers are those that were seen;
         *     of none seen in n it is only known that fewer than 3/n are to be expected.
         */
        Preview: {
            /** @description Each algorithm beside the fastest of its contract class, as far as both answered and were not wrong. */
            beside: components["schemas"]["Beside"][];
            /** @description What was found, in words. */
            finding: string;
            /**
             * Format: int32
             * @description How often it was looked whether the comparison is settled.
             */
            looks: number;
            /** @description What measuring all configurations would add, in words. */
            more: string;
            /**
             * Format: int32
             * @description Configurations measured.
             */
            n: number;
            /**
             * Format: int64
             * @description Configurations of the whole run; of a sampled set that was not found as a whole: before any is missed.
             */
            of: number;
            /**
             * Format: double
             * @description Differences below this share count as none.
             */
            precision: number;
            /** @description Every comparison is settled. All that is said of them together is false with a probability of at most 2 %. */
            settled: boolean;
        };
        /** @description An error: what is wrong, where, and how to mend it (RFC 9457, `application/problem+json`). */
        Problem: {
            /** @description One sentence for the person who asked. */
            detail: string;
            /**
             * Format: int32
             * @description HTTP status.
             */
            status: number;
            /** @description The status in words. */
            title: string;
            /** @description Kind of problem: always `about:blank`, the status says it. */
            type: string;
        };
        /**
         * @description The question of a run.
         * @enum {string}
         */
        Query: "collision_first" | "collision_all" | "proximity";
        /** @description The algorithm that takes part in every round of every run. */
        Reference: {
            /** @description Algorithm id. */
            algorithm: string;
            /** @description SHA-256 (hex) of its plugin file. */
            plugin_sha256: string;
        };
        /** @description A relation between answers. */
        RelationInfo: {
            /** @description Short name. */
            id: string;
            /** @description Name. */
            name: string;
            /** @description What must hold. */
            sentence: string;
        };
        /** @description One method on one relation. */
        RelationResult: {
            /**
             * Format: int32
             * @description Decisions that differ.
             */
            decisions: number;
            /**
             * Format: int32
             * @description Distances that differ.
             */
            distances: number;
            first?: components["schemas"]["FailingCase"] | null;
            /**
             * Format: int32
             * @description Decisions that differ within rounding of the other one, where they may.
             */
            grazing: number;
            /** @description The relation. */
            relation: string;
            /** @description By the amount of what was changed. */
            steps: components["schemas"]["RelationStep"][];
            /**
             * Format: int32
             * @description How often it was tried.
             */
            tried: number;
        };
        /** @description One amount of a relation. */
        RelationStep: {
            /**
             * Format: double
             * @description The amount, 0 when there is none.
             */
            at: number;
            /**
             * Format: int32
             * @description Decisions that differ.
             */
            decisions: number;
            /**
             * Format: int32
             * @description Distances that differ.
             */
            distances: number;
            /**
             * Format: int32
             * @description How often it was tried.
             */
            tried: number;
        };
        /** @description One question that is answered wrongly; `ocb plugin check FILE.so --repro FILE.json` asks it again. */
        Repro: {
            /** @description Algorithm id. */
            algorithm: string;
            /** @description It fails also when it is the only question. If not, answers depend on the questions before, and nothing was reduced. */
            alone: boolean;
            /** @description What the oracle says. */
            expected: string;
            /** @description What the plugin answered. */
            got: string;
            /** @description Object A as OBJ text, reduced to as few triangles as still fail. */
            object_a: string;
            /** @description Object B. */
            object_b: string;
            /** @description Pose of A, a row-major 4x4 matrix. */
            pose_a: number[];
            /** @description Pose of B. */
            pose_b: number[];
            /** @description The question. */
            query: components["schemas"]["Query"];
            /** @description Triangles of A and of B. */
            triangles: number[];
            /** @description What is wrong with it. */
            verdict: components["schemas"]["Verdict"];
        };
        /** @description eps* of one algorithm on one set. */
        Resolution: {
            distance?: components["schemas"]["DistanceError"] | null;
            /**
             * Format: double
             * @description eps*: the largest distance or margin, divided by S, at which an answer is wrong. When none is, eps* is at most
             *     this: the larger of the smallest ones tried on either side. Absent when nothing was tried.
             */
            eps?: number | null;
            /** @description Configurations that are apart, by distance / S: which are called a hit? */
            false_hits: components["schemas"]["Threshold"];
            /** @description Configurations that cross, by margin / S: which are missed? */
            misses: components["schemas"]["Threshold"];
            /** @description Some answer is wrong, so that `eps` is a value and no bound. */
            seen: boolean;
        };
        /**
         * @description What an account may do; each role may do what those before it may.
         * @enum {string}
         */
        Role: "user" | "developer" | "curator" | "administrator";
        /** @description Something that happened in a run. */
        RunEvent: {
            /**
             * Format: int64
             * @description When.
             */
            at_us: number;
            result?: components["schemas"]["AlgorithmResult"] | null;
            /**
             * Format: int32
             * @description Runs ahead, while queued.
             */
            runs_ahead: number;
            /**
             * Format: int64
             * @description Position in the run's log, from 1; the `id:` of the event stream.
             */
            seq: number;
            stage?: components["schemas"]["Stage"] | null;
            /** @description The run's state after it. */
            state: components["schemas"]["State"];
        };
        /** @description A run with everything a page needs to show it. */
        RunInfo: {
            /**
             * Format: int32
             * @description Times this run was started (more than 1 after a restart of the service).
             */
            attempts: number;
            /** @description The campaign that it belongs to. */
            campaign?: string | null;
            /**
             * @description SHA-256 of the secret that the seed is drawn from, published before anything is measured; absent when the seed was
             *     given.
             */
            commitment?: string | null;
            /**
             * Format: int64
             * @description When it was asked for.
             */
            created_us: number;
            environment?: components["schemas"]["Environment"] | null;
            /**
             * Format: int64
             * @description When it ended.
             */
            finished_us?: number | null;
            /** @description Id (UUIDv7). */
            id: string;
            /** @description Why it failed, one sentence. */
            message?: string | null;
            /** @description Made by the caller, who may cancel it and decides who sees it. */
            mine: boolean;
            /** @description Name of object A. */
            object_a_name: string;
            /** @description Name of object B. */
            object_b_name: string;
            preview?: components["schemas"]["Preview"] | null;
            /** @description The run that it repeats in that campaign. */
            rerun_of?: string | null;
            /** @description Summary per algorithm, as far as there is one. */
            results: components["schemas"]["AlgorithmResult"][];
            /**
             * Format: int32
             * @description Runs ahead, while queued.
             */
            runs_ahead: number;
            set?: components["schemas"]["SetInfo"] | null;
            /** @description What was asked, with defaults filled in. */
            spec: components["schemas"]["RunSpec"];
            /** @description The lanes, in order: object, configurations, one measuring lane per algorithm, heatmap. */
            stages: components["schemas"]["Stage"][];
            /** @description State. */
            state: components["schemas"]["State"];
            /** @description Who sees it: what its owner decided, and no more than see its objects. */
            visibility: components["schemas"]["Visibility"];
        };
        /** @description What to measure. */
        RunSpec: {
            /**
             * @description Algorithm ids, each with its settings behind it (`box-tree:leaf_size=4`); the usual ones that answer the question when
             *     empty, every one that does for `["all"]`.
             */
            algorithms?: string[];
            /**
             * Format: int32
             * @description A quick look: measure at most so many configurations, evenly spread over all of them.
             */
            at_most?: number | null;
            /**
             * Format: double
             * @description Measuring time allowed per algorithm; a slower one is measured on as many configurations (taken in a shuffled
             *     order that all algorithms share) as fit. Other units and counters are not part of it; each may take as long as two passes.
             */
            budget_seconds?: number;
            /** @description Instead of a relative distance: the ten steps of the ladder in turn, on which eps* is measured. */
            ladder?: boolean;
            /** @description How the configurations are found. */
            method: components["schemas"]["Method"];
            /** @description Object A (fixed). */
            object_a: string;
            /** @description Object B (moving); the same object when absent. */
            object_b?: string | null;
            /**
             * Format: int32
             * @description Fresh processes that see the unit of the files, with one timed pass over the configurations each (1 to 99). Two more
             *     share the configurations in a smaller unit, and two in a larger one.
             */
            passes?: number;
            /**
             * Format: double
             * @description Stop as soon as the algorithms are told apart, where differences below this share do not matter (0.05: 5 %). All
             *     configurations are measured when absent.
             */
            precision?: number | null;
            /** @description The question. */
            query: components["schemas"]["Query"];
            /**
             * Format: double
             * @description Surface distance divided by L, the longest side of A's bounding box; at least 0.
             */
            relative_distance?: number;
            /**
             * Format: int64
             * @description Seed of everything that is drawn while measuring (order, equivalent instances, blocks), below 2^53; to repeat a
             *     run. Drawn for every run when absent.
             */
            seed?: number | null;
            /** @description What counts as an object: surfaces, or solid bodies, which need closed objects and an algorithm that knows them. */
            semantics?: components["schemas"]["Semantics"];
            /**
             * Format: double
             * @description Instead of a relative distance: a step of the scene's size S, 7e-15 to 0.1, apart (above 0) or crossing (below 0).
             */
            step?: number | null;
        };
        /** @description How many directions and rotations, and in which pattern. */
        Sampling: {
            /** @enum {string} */
            kind: "steps";
            /**
             * Format: double
             * @description Move-by, degrees.
             */
            move: number;
            /**
             * Format: double
             * @description Rotate-by, degrees.
             */
            rotate: number;
        } | {
            /** @enum {string} */
            kind: "paper_compat";
            /**
             * Format: double
             * @description Move-by, degrees.
             */
            move: number;
            /**
             * Format: double
             * @description Rotate-by, degrees.
             */
            rotate: number;
        } | {
            /**
             * Format: int32
             * @description Number of configurations.
             */
            count: number;
            /** @enum {string} */
            kind: "count";
        };
        /**
         * @description How numbers become places.
         * @enum {string}
         */
        Scale: "linear" | "log" | "signed" | "rows";
        /**
         * @description What a token may be used for.
         * @enum {string}
         */
        Scope: "runs" | "plugins";
        /** @description The search from anywhere toward failures and long times, beside as many uniform questions. */
        SearchResult: {
            /**
             * Format: int32
             * @description The number of the first wrong answer of the search; absent when there was none.
             */
            climbing?: number | null;
            /**
             * Format: double
             * @description The longest time that the search found, nanoseconds.
             */
            costliest_climbing_ns: number;
            /**
             * Format: double
             * @description The longest time of as many uniform questions.
             */
            costliest_uniform_ns: number;
            first?: components["schemas"]["FailingCase"] | null;
            /**
             * Format: int32
             * @description Questions allowed to each.
             */
            most: number;
            /**
             * Format: int32
             * @description The same for uniform questions.
             */
            uniform?: number | null;
        };
        /** @description How many configurations a selection holds, and what they cost. */
        Selected: {
            /** @description Every algorithm of the run that has records. */
            algorithms: components["schemas"]["SelectedOf"][];
            /**
             * Format: int32
             * @description Configurations in it.
             */
            n: number;
            /**
             * Format: int32
             * @description Configurations in the set.
             */
            of: number;
            /** @description The selection as it was understood. */
            where: string;
        };
        /** @description The selected configurations of one algorithm. */
        SelectedOf: {
            /** @description Algorithm id. */
            algorithm: string;
            /**
             * Format: double
             * @description Largest time.
             */
            max_ns?: number | null;
            /**
             * Format: double
             * @description Median time, nanoseconds; absent without any.
             */
            median_ns?: number | null;
            /**
             * Format: int32
             * @description Selected configurations on which it was measured.
             */
            n: number;
            /**
             * Format: double
             * @description 99th percentile of the time.
             */
            p99_ns?: number | null;
            /**
             * Format: int32
             * @description Wrong answers among them.
             */
            wrong: number;
        };
        /**
         * @description What counts as an object.
         * @enum {string}
         */
        Semantics: "surface" | "solid";
        /**
         * @description How far apart, or how deep in each other, the surfaces shall be.
         *
         *     Each configuration of a set aims at a place of its own in the window, so that no distance is right for all of them.
         *
         *     One rule for all: a wanted *step* `x` of the scene's size S ([`Pair::scene_size`](crate::oracle::Pair::scene_size))
         *     is met by a certified value in `(x S, 2 x S]`.
         */
        Separation: {
            /**
             * Format: double
             * @description Surface distance divided by L; at least 0.
             */
            distance: number;
            /** @enum {string} */
            kind: "relative";
        } | {
            /** @enum {string} */
            kind: "step";
            /**
             * Format: double
             * @description `x`; its size is at least [`Separation::SMALLEST_STEP`].
             */
            of_size: number;
        } | {
            /** @enum {string} */
            kind: "ladder";
        };
        /** @description Points that belong together. */
        Series: {
            /** @description How it is drawn. */
            form: components["schemas"]["Form"];
            /** @description Name in the key. */
            name: string;
            /** @description In the order in which they are joined. */
            points: components["schemas"]["Point"][];
            /**
             * Format: int32
             * @description Which of the eight styles; absent: plain grey.
             */
            style?: number | null;
        };
        /** @description The configuration set of a run. */
        SetInfo: {
            /**
             * Format: double
             * @description Side of the cube of random placement.
             */
            box_side?: number | null;
            /** @description How many are of which class in f64. */
            classes: components["schemas"]["ClassCount"][];
            /**
             * Format: int32
             * @description Configurations.
             */
            configurations: number;
            /**
             * Format: double
             * @description Share of A's triangles that are a closest feature at least once.
             */
            coverage_a: number;
            /**
             * Format: double
             * @description The same of B.
             */
            coverage_b: number;
            /**
             * Format: double
             * @description How evenly: entropy of the closest features over A's triangles, divided by its maximum (1: all equally often).
             */
            evenness_a?: number;
            /**
             * Format: double
             * @description The same of B.
             */
            evenness_b?: number;
            /**
             * Format: int32
             * @description Configurations whose truth needed exact arithmetic.
             */
            exact?: number;
            /**
             * Format: int32
             * @description Positions that no ray from outside toward A's centre meets first.
             */
            further_roots?: number;
            /**
             * Format: double
             * @description L, the longest side of A's bounding box.
             */
            longest_side: number;
            /**
             * Format: int32
             * @description Rays on which no position was found.
             */
            missed_rays: number;
            /**
             * Format: int32
             * @description Version of the oracle that certified it; absent in sets of older versions.
             */
            oracle?: number | null;
            /** @description SHA-256 (hex) of the stored set. */
            sha256: string;
            /**
             * Format: double
             * @description Distance between the nodes of the grid method.
             */
            spacing?: number | null;
        };
        /** @description A share of some cases with its 95 % interval. */
        Share: {
            /**
             * Format: double
             * @description Upper end; where none was seen, three divided by the number of cases.
             */
            hi: number;
            /**
             * Format: double
             * @description Lower end of the interval (Wilson 1927).
             */
            lo: number;
            /**
             * Format: int32
             * @description Of how many.
             */
            of: number;
            /**
             * Format: int32
             * @description How many were seen.
             */
            seen: number;
        };
        /**
         * @description Which object of the scene.
         * @enum {string}
         */
        Side: "a" | "b";
        /** @description A key that plugins may be signed with. */
        SigningKey: {
            /** @description A minisign public key: the file `minisign.pub`, or its last line. */
            public_key: string;
        };
        /** @description One method. */
        Stability: {
            /** @description The algorithm with its settings. */
            algorithm: string;
            /** @description Everything that was asked for was asked; false when the time ran out. */
            complete: boolean;
            /**
             * Format: int64
             * @description When, microseconds since the epoch.
             */
            created_us: number;
            /** @description By reported failure. */
            failures: components["schemas"]["FailureResult"][];
            /** @description By family. */
            families: components["schemas"]["FamilyResult"][];
            /** @description Its name. */
            name: string;
            /**
             * Format: double
             * @description The farthest offset from the origin up to which nothing is wrong; absent when none is.
             */
            offset_safe?: number | null;
            /** @description SHA-256 of the plugin file. */
            plugin_sha256: string;
            /** @description By relation. */
            relations: components["schemas"]["RelationResult"][];
            search?: components["schemas"]["SearchResult"] | null;
            /**
             * Format: int32
             * @description Seeds per value of a parameter.
             */
            seeds: number;
            /** @description It computes in f32 and is judged in the wider band. */
            single_precision: boolean;
            /** @description The same surfaces cut into other triangles. */
            tessellations: components["schemas"]["TessellationResult"][];
            /**
             * @description The powers of two between which another unit of length changes no answer; absent when not even the smallest tried
             *     on either side leaves it.
             */
            unit_safe?: number[] | null;
            /** @description Its version. */
            version: string;
        };
        /** @description Stress families that a method got through. */
        StabilityPassed: {
            /**
             * Format: int32
             * @description Of those that it answers.
             */
            of: number;
            /**
             * Format: int32
             * @description Families without a wrong answer, a crash or a hang.
             */
            passed: number;
        };
        /** @description Everything known, and what it means. */
        StabilityTable: {
            /** @description The reported failures. */
            failures: components["schemas"]["FailureInfo"][];
            /** @description The families, in the order of the tables. */
            families: components["schemas"]["FamilyInfo"][];
            /** @description One entry per method that was tried, by id. */
            methods: components["schemas"]["Stability"][];
            /** @description The relations, in the order of the tables. */
            relations: components["schemas"]["RelationInfo"][];
        };
        /** @description One lane of the live page. */
        Stage: {
            /** @description The algorithm, for measuring lanes. */
            algorithm?: string | null;
            /**
             * Format: int64
             * @description Items done (configurations, queries).
             */
            done: number;
            /** @description Which lane. */
            kind: components["schemas"]["StageKind"];
            /** @description Note or cause, one sentence. */
            message?: string | null;
            /**
             * Format: double
             * @description Items per second lately.
             */
            rate: number;
            /**
             * Format: double
             * @description Expected seconds left, when known.
             */
            seconds_left?: number | null;
            /** @description State. */
            state: components["schemas"]["State"];
            /**
             * Format: int64
             * @description Items in all (0: unknown yet).
             */
            total: number;
        };
        /**
         * @description Which lane.
         * @enum {string}
         */
        StageKind: "object" | "configurations" | "measuring" | "heatmap";
        /**
         * @description What is known of an algorithm beside the fastest.
         * @enum {string}
         */
        Standing: "slower" | "equal" | "open";
        /**
         * @description State of a run or of a stage.
         * @enum {string}
         */
        State: "queued" | "running" | "done" | "failed" | "cancelled";
        /**
         * @description A statistic of a sample.
         * @enum {string}
         */
        Statistic: "mean" | "median" | "min" | "max" | "standard_deviation" | "mad";
        /** @description The service at a glance. */
        Status: {
            /**
             * Format: int32
             * @description Algorithms offered.
             */
            algorithms: number;
            /** @description Hardware class of this machine. */
            hardware_class: string;
            /** @description What keeps something from being offered, e.g. a plugin that does not load; one sentence each. */
            problems: string[];
            /**
             * Format: int32
             * @description Runs waiting.
             */
            queued: number;
            /**
             * Format: int32
             * @description Runs at work (0 or 1).
             */
            running: number;
            /** @description Version of this program. */
            version: string;
        };
        /** @description One value of the parameter. */
        StepResult: {
            /**
             * Format: double
             * @description The value.
             */
            at: number;
            /** @description What was seen. */
            tally: components["schemas"]["Tally"];
        };
        /** @description The suite of this service: every scene at every separation, asked every question. */
        SuiteInfo: {
            /**
             * Format: int32
             * @description Configurations of each scenario.
             */
            configurations: number;
            /** @description The hardware class of this machine, for which the progress is told. */
            hardware_class: string;
            /**
             * Format: int32
             * @description Version of the oracle that judges.
             */
            oracle: number;
            /**
             * Format: int32
             * @description Fresh processes for each algorithm.
             */
            passes: number;
            /** @description How far each public algorithm has come, by id. */
            progress: components["schemas"]["SuiteProgress"][];
            /** @description What is asked. */
            queries: components["schemas"]["Query"][];
            /**
             * Format: int32
             * @description Scenarios: scenes times separations times queries.
             */
            scenarios: number;
            /** @description Objects A and B of each scene. */
            scenes: string[][];
            /** @description How far apart, or how deep in each other. */
            separations: components["schemas"]["Separation"][];
            /** @description SHA-256 (hex) of its file. */
            sha256: string;
            /**
             * Format: int32
             * @description Its version: another one for every change.
             */
            version: number;
        };
        /** @description How far an algorithm has come with the suite. */
        SuiteProgress: {
            /** @description Algorithm id. */
            algorithm: string;
            /**
             * Format: int32
             * @description Scenarios with a result of its file here.
             */
            measured: number;
            /** @description Display name. */
            name: string;
            /**
             * Format: int32
             * @description Scenarios whose question it answers.
             */
            of: number;
            /**
             * Format: int32
             * @description Scenarios that are in the queue.
             */
            waiting: number;
        };
        /** @description Counts of answers. */
        Tally: {
            /**
             * Format: int32
             * @description Right, as far as can be judged.
             */
            agrees: number;
            /**
             * Format: int32
             * @description Crash, hang, or no number.
             */
            broken: number;
            /**
             * Format: int32
             * @description Wrong distances, nearest points or pairs.
             */
            distances: number;
            /**
             * Format: int32
             * @description False alarms.
             */
            false_alarms: number;
            /**
             * Format: int32
             * @description Of those: within rounding of the other answer, where either is allowed.
             */
            grazing: number;
            /**
             * Format: int32
             * @description Missed collisions.
             */
            misses: number;
            /**
             * Format: int32
             * @description Refused by the host.
             */
            refused: number;
            /**
             * Format: int32
             * @description More than ten times the median time.
             */
            slow: number;
            /**
             * Format: int32
             * @description Another answer than to the same question before.
             */
            unsteady: number;
            /**
             * Format: int32
             * @description Not answered: not offered, or given up.
             */
            unsupported: number;
        };
        /** @description One method on one cutting of a surface into triangles. */
        TessellationResult: {
            /** @description How it is cut. */
            cut: string;
            /**
             * Format: int32
             * @description Decisions that differ from those for the original.
             */
            decisions: number;
            /**
             * Format: double
             * @description The largest difference of a distance from that for the original, in lengths of the object.
             */
            distance: number;
            /**
             * Format: double
             * @description Median time, nanoseconds.
             */
            median_ns: number;
            /**
             * Format: int32
             * @description Questions that were answered.
             */
            n: number;
            /** @description The surface. */
            object: string;
            /** @description The question. */
            query: components["schemas"]["Query"];
            /**
             * Format: double
             * @description The median, over the same questions, of this time divided by that for the original.
             */
            ratio: number;
            /**
             * Format: int32
             * @description Triangles of each object.
             */
            triangles: number;
            /**
             * Format: int32
             * @description Answers that are wrong for the surface as it is cut.
             */
            wrong: number;
        };
        /** @description One side of eps*. */
        Threshold: {
            /**
             * Format: double
             * @description When some are wrong: the largest distance or margin, divided by S, at which one is. When none is: the smallest
             *     that was tried, so that the resolution is at least as good as this. Absent when none was tried.
             */
            at?: number | null;
            /** @description The same by powers of ten of the distance or margin, ascending; empty in results of older versions. */
            decades?: components["schemas"]["Decade"][];
            /**
             * Format: int32
             * @description Configurations of this side that were answered.
             */
            n: number;
            /**
             * Format: int32
             * @description Those answered wrongly, however narrow the decision.
             */
            wrong: number;
        };
        /** @description Between what holds and what fails. */
        ThresholdInfo: {
            /**
             * Format: double
             * @description The first value at which something fails.
             */
            fails: number;
            /**
             * Format: double
             * @description The last value at which nothing fails; absent when the easiest fails already.
             */
            holds?: number | null;
        };
        /** @description Distribution of the time per query over configurations, nanoseconds. */
        TimeSummary: {
            /**
             * Format: int32
             * @description How many lie below the clock's resolution.
             */
            below_resolution: number;
            /** @description Maximum; its interval is over the configurations. */
            max_ns: components["schemas"]["Estimated"];
            /**
             * @description Arithmetic mean. Its interval and the following two are over the processes; over the configurations, too, where there is
             *     one process only or not every configuration was measured.
             */
            mean_ns: components["schemas"]["Estimated"];
            /** @description Median. */
            median_ns: components["schemas"]["Estimated"];
            /** @description 95th percentile. */
            p95_ns: components["schemas"]["Estimated"];
        };
        /** @description How the timed passes of one algorithm went. */
        Timing: {
            /**
             * Format: int32
             * @description All blocks.
             */
            blocks: number;
            /** @description The integrity checks for which there was enough to go by. */
            checks: components["schemas"]["TimingCheck"][];
            /**
             * Format: int32
             * @description Blocks of questions that were disturbed, of all; a time from one counts only where its configuration has no other.
             */
            disturbed_blocks: number;
            /**
             * Format: int32
             * @description Fresh processes.
             */
            processes: number;
            /**
             * Format: int32
             * @description Questions in batches.
             */
            warm_n: number;
            /**
             * Format: double
             * @description Mean time per question in batches, nanoseconds; absent without batches.
             */
            warm_ns?: number | null;
        };
        /** @description One integrity check. */
        TimingCheck: {
            /** @description What honest plugins stay within. */
            allowed: number[];
            /** @description Name of the check. */
            check: string;
            /**
             * Format: double
             * @description What was measured.
             */
            found: number;
        };
        /** @description A token for programs, without its secret. */
        TokenInfo: {
            /**
             * Format: int64
             * @description When it was made.
             */
            created_us: number;
            /**
             * Format: int64
             * @description When it ends.
             */
            expires_us: number;
            /** @description Its id. */
            id: string;
            /** @description What its owner calls it. */
            name: string;
            /** @description What it may be used for. */
            scopes: components["schemas"]["Scope"][];
        };
        /** @description A token that is asked for. */
        TokenRequest: {
            /** @description What its owner calls it, 1 to 80 characters. */
            name: string;
            /** @description What it may be used for. */
            scopes: components["schemas"]["Scope"][];
        };
        /**
         * @description That time or answers depend on the unit of length. A time does when every process in another unit takes more than 1.5
         *     times as long as every process in the unit of the files, or the other way round, and the means are 500 ns apart or more. Wrong
         *     answers do when, on the configurations asked in both units, chance would distribute them so unevenly with a probability
         *     below 1 %.
         */
        UnitDependence: {
            /** @description Units in which another share of the answers is wrong. */
            answers: number[];
            /** @description Both as one sentence. */
            message: string;
            /** @description Units in which the time differs, as exponents. */
            time: number[];
        };
        /** @description Why an algorithm has no rank although it failed nowhere else. */
        Unranked: components["schemas"]["UnrankedCause"] & {
            /** @description The same as one sentence. */
            message: string;
        };
        /** @description What takes a rank away. */
        UnrankedCause: {
            /** @enum {string} */
            cause: "wrong_controls";
            /**
             * Format: int32
             * @description Of these.
             */
            n: number;
            /**
             * Format: int32
             * @description So many.
             */
            wrong: number;
        } | {
            /** @enum {string} */
            cause: "silent_controls";
            /**
             * Format: int32
             * @description Of these.
             */
            n: number;
            /**
             * Format: int32
             * @description So many.
             */
            silent: number;
        } | {
            /** @enum {string} */
            cause: "few_controls";
            /**
             * Format: int32
             * @description Needed.
             */
            least: number;
            /**
             * Format: int32
             * @description Answered.
             */
            n: number;
            /**
             * Format: int32
             * @description Drawn.
             */
            of: number;
        } | {
            /** @enum {string} */
            cause: "kept_waiting";
            /**
             * Format: double
             * @description The same of the reference algorithm, over all its processes.
             */
            reference: number;
            /**
             * Format: double
             * @description Share of its processes' time, the median over them.
             */
            share: number;
        };
        /**
         * @description The comparison of one answer with the oracle.
         * @enum {string}
         */
        Verdict: "correct" | "false_negative" | "false_positive" | "distance_over" | "distance_under" | "wrong_witness" | "invalid" | "undecidable" | "gave_up" | "unsupported";
        /** @description Count of one verdict. */
        VerdictCount: {
            /**
             * Format: int32
             * @description How many.
             */
            count: number;
            /** @description The verdict. */
            verdict: components["schemas"]["Verdict"];
        };
        /** @description The value at one vertex of a heatmap. */
        VertexValue: {
            /**
             * Format: int32
             * @description Values that went into it after outlier removal.
             */
            count: number;
            /**
             * Format: int32
             * @description Values that outlier removal took from it.
             */
            dropped: number;
            /** @description Unit of the value, as in the heatmap. */
            unit: string;
            /**
             * Format: double
             * @description The value; null where there is none.
             */
            value?: number | null;
            /**
             * Format: int32
             * @description Vertex index, from 0, in the object's order.
             */
            vertex: number;
        };
        /**
         * @description Who sees an object or a run; to others it is not there.
         * @enum {string}
         */
        Visibility: "private" | "unlisted" | "public";
        /** @description One of the worst configurations of an algorithm. */
        WorstCase: {
            claim?: components["schemas"]["Claim"] | null;
            /**
             * Format: int32
             * @description Index of the configuration in the set.
             */
            configuration: number;
            /**
             * Format: double
             * @description The answer: how far apart.
             */
            distance?: number | null;
            /**
             * Format: double
             * @description How far that lies outside the certified interval, in u S.
             */
            error?: number | null;
            /**
             * Format: int32
             * @description Answers to equivalent instances that contradict the first one; absent in old records.
             */
            flips?: number | null;
            /** @description The answer: do they collide; absent when a distance was asked, or nothing answered. */
            hit?: boolean | null;
            /**
             * Format: double
             * @description How far every vertex may move and the crossing still holds.
             */
            margin: number;
            /** @description Certified witness points in the world, on A and on B; a common point twice when they collide. */
            points: number[][];
            /** @description Pose of A: object to world, row-major 4x4. */
            pose_a: number[];
            /** @description Pose of B. */
            pose_b: number[];
            /**
             * Format: double
             * @description Time of the query, nanoseconds.
             */
            time_ns: number;
            /** @description The triangles of A and B that hold them. */
            triangles: number[];
            /** @description The truth: certified bounds of the distance. */
            true_distance: number[];
            /** @description The truth: do they collide. */
            true_hit: boolean;
            /** @description What the answer is worth. */
            verdict: components["schemas"]["Verdict"];
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    show_account: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Identity"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    make_account: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Credentials"];
            };
        };
        responses: {
            /** @description Created and logged in */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Identity"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The name is taken */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No name or no password */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many accounts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    delete_account: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["DeleteAccount"];
            };
        };
        responses: {
            /** @description What was deleted and what stays; all sessions are closed */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["DeletionPreview"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Wrong password */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The account is the last curator or administrator, or a run is just ending */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No password */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    give_address: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewAddress"];
            };
        };
        responses: {
            /** @description All current choices */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Choices"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not an address */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    forget_address: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description All current choices */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Choices"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    confirm_address: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["OpenedLink"];
            };
        };
        responses: {
            /** @description All current choices */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Choices"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The link is not valid for this account or has expired; the answer does not say which */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_choices: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Choices"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    choose: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewChoices"];
            };
        };
        responses: {
            /** @description All current choices */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Choices"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_deletion_preview: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["DeletionPreview"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ask_to_develop: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["DeveloperRequest"];
            };
        };
        responses: {
            /** @description Requested */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already a developer */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No reason given */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    accept_invitation: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Acceptance"];
            };
        };
        responses: {
            /** @description The updated account */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AccountInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The invitation does not exist or has expired; the answer does not say which */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already a developer */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    log_in: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Credentials"];
            };
        };
        responses: {
            /** @description Logged in */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Identity"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Wrong user name or password */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is missing */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    log_out: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Logged out */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    log_out_everywhere: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Logged out everywhere */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_password: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewPassword"];
            };
        };
        responses: {
            /** @description Changed; log in again */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The old password is wrong */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The new password is too short */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    register_key: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SigningKey"];
            };
        };
        responses: {
            /** @description The updated account */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AccountInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a minisign public key */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    forget_key: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The key was removed */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_tokens: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenInfo"][];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    make_token: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TokenRequest"];
            };
        };
        responses: {
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewToken"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many tokens */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No name or no scope */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    end_token: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Token id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The token was revoked */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such token */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_accounts: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AccountInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_role: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Account id */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewRole"];
            };
        };
        responses: {
            /** @description The updated account */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AccountInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not permitted for this curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such account */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a role */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ask_advice: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AdviceSpec"];
            };
        };
        responses: {
            /** @description Already requested with this key */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AdviceInfo"];
                };
            };
            /** @description Queued; its address is in `Location` */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AdviceInfo"];
                };
            };
            /** @description Not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The question is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests are queued; `Retry-After` says when to try again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_advice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Advice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AdviceInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such advice */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancel_advice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Advice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated advice */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AdviceInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description It belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such advice */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reduced_certificate: {
        parameters: {
            query: {
                /** @description Of which object. */
                side: components["schemas"]["Side"];
                /** @description Which of its reduced objects, from 0: the coarsest first. */
                stage?: number;
            };
            header?: never;
            path: {
                /** @description Advice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Content hashes, thickness and deviation of every triangle */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": string;
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such advice, or it reduces nothing there */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reduced_obj: {
        parameters: {
            query: {
                /** @description Of which object. */
                side: components["schemas"]["Side"];
                /** @description Which of its reduced objects, from 0: the coarsest first. */
                stage?: number;
            };
            header?: never;
            path: {
                /** @description Advice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The mesh */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "model/obj": string;
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such advice, or it reduces nothing there */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_algorithms: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AlgorithmInfo"][];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_board: {
        parameters: {
            query?: {
                /**
                 * @description Version of the suite whose results are compared, or `none` for the runs of people. The newest suite that was measured
                 *     when left out.
                 */
                suite?: string;
                /** @description The question: `collision_first`, `collision_all` or `proximity`, with `+solid` behind it for solid bodies. */
                question?: string;
                /** @description Contract class, e.g. `first_contact-shuffled-1-f64`. */
                class?: string;
                /** @description Hardware class. */
                hardware?: string;
                /** @description Pair of objects, e.g. `bunny@3674~bunny@3674`; `all` takes every one, as is done for a suite when left out. */
                scene?: string;
                /**
                 * @description How far apart: a relative distance such as `0.1`, `step:0.0001`, `ladder`, `grid:0`, ...; `all` takes every one, as is done
                 *     for a suite when left out.
                 */
                distance?: string;
                /** @description What is needed: `any`, `none_seen` (no wrong answer), or the largest eps* that will do, e.g. `1e-6`. */
                precision?: string;
                /** @description What to chart speed against. */
                accuracy?: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Board"];
                };
            };
            /** @description Unknown measure of accuracy */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The precision is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_board_csv: {
        parameters: {
            query?: {
                /**
                 * @description Version of the suite whose results are compared, or `none` for the runs of people. The newest suite that was measured
                 *     when left out.
                 */
                suite?: string;
                /** @description The question: `collision_first`, `collision_all` or `proximity`, with `+solid` behind it for solid bodies. */
                question?: string;
                /** @description Contract class, e.g. `first_contact-shuffled-1-f64`. */
                class?: string;
                /** @description Hardware class. */
                hardware?: string;
                /** @description Pair of objects, e.g. `bunny@3674~bunny@3674`; `all` takes every one, as is done for a suite when left out. */
                scene?: string;
                /**
                 * @description How far apart: a relative distance such as `0.1`, `step:0.0001`, `ladder`, `grid:0`, ...; `all` takes every one, as is done
                 *     for a suite when left out.
                 */
                distance?: string;
                /** @description What is needed: `any`, `none_seen` (no wrong answer), or the largest eps* that will do, e.g. `1e-6`. */
                precision?: string;
                /** @description What to chart speed against. */
                accuracy?: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One line per algorithm with its settings */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The precision is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_campaigns: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CampaignInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    create_campaign: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["CampaignRequest"];
            };
        };
        responses: {
            /** @description Already requested with this key */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CampaignInfo"];
                };
            };
            /** @description Queued; its address is in `Location` */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CampaignInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description There is nothing to measure again */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No reason, or neither suite nor people */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    preview_campaign: {
        parameters: {
            query?: {
                /** @description The suite. */
                suite?: boolean;
                /** @description Public runs whose accounts agree. */
                people?: boolean;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    /**
                     * @example {
                     *       "expected_seconds": 5400,
                     *       "hardware_class": "0d52c1f3b7a96e48",
                     *       "oracle": 5,
                     *       "peoples_runs": 12,
                     *       "suite_repeats": 144,
                     *       "suite_runs": 150,
                     *       "suite_version": 1
                     *     }
                     */
                    "application/json": components["schemas"]["CampaignPreview"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_campaign: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Campaign id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CampaignInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such campaign */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancel_campaign: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Campaign id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated campaign */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["CampaignInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such campaign */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_curation: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_data: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    delete_all: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What was deleted */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A run is just ending */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_data: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A folder per item, with JSON, OBJ and Parquet files */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/x-tar": number[];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many archives are being downloaded */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    keep_longer: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    estimate_run: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "algorithms": [
                 *         "ocb-fast",
                 *         "box-tree"
                 *       ],
                 *       "method": {
                 *         "kind": "sphere",
                 *         "sampling": {
                 *           "count": 1000,
                 *           "kind": "count"
                 *         }
                 *       },
                 *       "object_a": "stock:torus-knot@8000",
                 *       "query": "proximity",
                 *       "relative_distance": 0.1
                 *     }
                 */
                "application/json": components["schemas"]["RunSpec"];
            };
        };
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Estimate"];
                };
            };
            /** @description Not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The spec cannot be run */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    featured_run: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"] | null;
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_invitations: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["InvitationInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    invite: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "days": 14,
                 *       "recipient": "Ada, of the GJK paper"
                 *     }
                 */
                "application/json": components["schemas"]["InvitationRequest"];
            };
        };
        responses: {
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewInvitation"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many invitations are open */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No recipient, or valid for too long */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revoke_invitation: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Invitation id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated invitation */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["InvitationInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a curator */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such invitation */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already accepted or withdrawn */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    turn_mails_off: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /**
                 * @description The part of the link after the last `/`
                 * @example 5d0c4b7e9f1a4c6e8b3d2f1a0c9e8d7b6a5f4e3d2c1b40a98f7e6d5c4b3a2918
                 */
                secret: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Mail is turned off */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The link is not valid or has expired; the answer does not say which */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many wrong links */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_notices: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NoticeInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_notice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Notice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Deleted */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such notice of this account */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    read_notice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Notice id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated notice */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NoticeInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such notice of this account */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_objects: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ObjectInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    add_object: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "multipart/form-data": {
                    /**
                     * Format: binary
                     * @description An OBJ file of at most 256 MiB.
                     */
                    file: string;
                };
            };
        };
        responses: {
            /** @description The object */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ObjectInfo"];
                };
            };
            /** @description The upload is not well-formed */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Larger than 256 MiB */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a usable OBJ file; the message has line and reason */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many uploads; `Retry-After` says when to try again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_object: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Object id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ObjectInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_object: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Object id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What was deleted */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The object belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A run with this object is just ending */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deletion_preview_of_object: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Object id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What DELETE of the object deletes */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The object belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    object_mesh: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Object id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The mesh */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "model/gltf-binary": number[];
                };
            };
            /** @description Unchanged (If-None-Match) */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_object_visibility: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Object id */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewVisibility"];
            };
        };
        responses: {
            /** @description The updated object */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ObjectInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The object belongs to someone else, or a guest tries to publish */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_document: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description OpenAPI 3.1 */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": unknown;
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_plugins: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    submit_plugin: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "multipart/form-data": {
                    /**
                     * Format: binary
                     * @description A shared library of at most 64 MiB.
                     */
                    file: string;
                    /** @description A `Manifest` as JSON; it comes before the file. */
                    manifest: string;
                    /** @description The content of a `.minisig` file, by the key that the account has registered; it comes before the file, too. */
                    signature?: string | null;
                };
            };
        };
        responses: {
            /** @description Already submitted */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"];
                };
            };
            /** @description Stored; its check is queued */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"];
                };
            };
            /** @description The form is not valid */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a developer */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many plugins are waiting, or the quota is used up */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No plugin, no manifest, or a signature that does not match */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many uploads */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_plugin: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Plugin id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such plugin */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cite_plugin: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Plugin id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Citation"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such plugin */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    decide: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Plugin id */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Decision"];
            };
        };
        responses: {
            /** @description The updated plugin */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PluginInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not authenticated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not permitted for this account */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such plugin */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not possible in the plugin's current state */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Unknown action, or no reason */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    follow_plugin: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Plugin id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The events */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": components["schemas"]["PluginInfo"];
                };
            };
            /** @description The check has ended */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such plugin */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_runs: {
        parameters: {
            query?: {
                /** @description Entries at most, from 1 to 200. */
                limit?: number;
                /** @description Start of the page, from the `Link` header of the previous page; absent for the first page. */
                cursor?: string;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description A page of the list */
            200: {
                headers: {
                    /** @description The next page: `<...>; rel="next"`; absent on the last page */
                    Link?: string;
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Invalid page parameters */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    start_run: {
        parameters: {
            query?: never;
            header?: {
                /**
                 * @description 1 to 200 visible characters, another one for every request; the same request under the same key makes nothing new. Kept
                 *     as long as a run, and for 30 days otherwise.
                 */
                "Idempotency-Key"?: string | null;
            };
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                /**
                 * @example {
                 *       "algorithms": [
                 *         "ocb-fast",
                 *         "box-tree"
                 *       ],
                 *       "method": {
                 *         "kind": "sphere",
                 *         "sampling": {
                 *           "count": 1000,
                 *           "kind": "count"
                 *         }
                 *       },
                 *       "object_a": "stock:torus-knot@8000",
                 *       "query": "proximity",
                 *       "relative_distance": 0.1
                 *     }
                 */
                "application/json": components["schemas"]["RunSpec"];
            };
        };
        responses: {
            /** @description Already requested with this key */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description Queued; its address is in `Location` */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description Not JSON */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` does not have the required scope, or the request was sent by a page of another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such object */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The spec cannot be run, or exceeds the owner's time limit */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many runs are queued or running; `Retry-After` says when to try again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    remove_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What was deleted */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run is just ending */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cancel_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_chart: {
        parameters: {
            query: {
                /** @description Kind. */
                kind: components["schemas"]["ChartKind"];
                /** @description For `accuracy`: what to chart speed against. */
                accuracy?: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
                /**
                 * @description For `ecdf`, `bv_tests` and `primitive_tests`: only the configurations of this selection, e.g.
                 *     `time of parry in [1ms, 1s] & near(vertex 8367, 0.05)`.
                 */
                where?: string;
                /** @description Algorithm whose columns are meant where the selection names none [default: the run's only one]. */
                algorithm?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Chart"];
                };
            };
            /** @description Unknown kind */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or nothing to chart */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    chart_as_csv: {
        parameters: {
            query: {
                /** @description Kind. */
                kind: components["schemas"]["ChartKind"];
                /** @description For `accuracy`: what to chart speed against. */
                accuracy?: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
                /**
                 * @description For `ecdf`, `bv_tests` and `primitive_tests`: only the configurations of this selection, e.g.
                 *     `time of parry in [1ms, 1s] & near(vertex 8367, 0.05)`.
                 */
                where?: string;
                /** @description Algorithm whose columns are meant where the selection names none [default: the run's only one]. */
                algorithm?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One line per point */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or nothing to chart */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    chart_as_parquet: {
        parameters: {
            query: {
                /** @description Kind. */
                kind: components["schemas"]["ChartKind"];
                /** @description For `accuracy`: what to chart speed against. */
                accuracy?: "wrong" | "missed" | "false_alarms" | "digits" | "distance";
                /**
                 * @description For `ecdf`, `bv_tests` and `primitive_tests`: only the configurations of this selection, e.g.
                 *     `time of parry in [1ms, 1s] & near(vertex 8367, 0.05)`.
                 */
                where?: string;
                /** @description Algorithm whose columns are meant where the selection names none [default: the run's only one]. */
                algorithm?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One row per point */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.parquet": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or nothing to chart */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    cite_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Citation"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or nothing measured */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run has not ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    columns_arrow: {
        parameters: {
            query: {
                /** @description Algorithm id. */
                algorithm: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The columns by their names in selections */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.arrow.stream": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of this algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    configurations_parquet: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One row per configuration */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.parquet": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no configurations yet */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_meeting: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
                /** @description Index in the set, from 0 */
                configuration: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Meeting"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run or configuration */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    deletion_preview_of_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description What DELETE of the run deletes */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["OwnedItems"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_ecdf: {
        parameters: {
            query: {
                /** @description Algorithm id. */
                algorithm: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ecdf"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of this algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    follow_run: {
        parameters: {
            query?: never;
            header?: {
                /** @description Sequence number of the last event seen */
                "Last-Event-ID"?: number | null;
            };
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The events */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": components["schemas"]["RunEvent"];
                };
            };
            /** @description The run has ended and every event was seen */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Last-Event-ID is not a number */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_heatmap: {
        parameters: {
            query: {
                /** @description Algorithm id (ignored for density). */
                algorithm: string;
                /** @description Which object. */
                side?: components["schemas"]["Side"];
                /** @description What to show. */
                measure: components["schemas"]["Measure"];
                /** @description Which statistic. */
                statistic: components["schemas"]["Statistic"];
                /** @description What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped. */
                outliers?: components["schemas"]["Outliers"];
                /** @description Show the difference to this algorithm: the values of `algorithm` minus its values. */
                against?: string;
                /** @description Subtract the values of another run on the same object; of the same algorithm unless `against` names another one. */
                against_run?: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Heatmap"];
                };
            };
            /** @description Unknown measure, statistic, ... */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no such values in it */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such values: errors of a run without distance queries, another object, ... */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    heatmap_glb: {
        parameters: {
            query: {
                /** @description Algorithm id (ignored for density). */
                algorithm: string;
                /** @description Which object. */
                side?: components["schemas"]["Side"];
                /** @description What to show. */
                measure: components["schemas"]["Measure"];
                /** @description Which statistic. */
                statistic: components["schemas"]["Statistic"];
                /** @description What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped. */
                outliers?: components["schemas"]["Outliers"];
                /** @description Show the difference to this algorithm: the values of `algorithm` minus its values. */
                against?: string;
                /** @description Subtract the values of another run on the same object; of the same algorithm unless `against` names another one. */
                against_run?: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
                /** @description Colormap. */
                colormap?: "turbo" | "viridis" | "cividis" | "purple_orange";
                /** @description Scale. */
                scale?: "linear" | "log";
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The coloured mesh */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "model/gltf-binary": number[];
                };
            };
            /** @description Unknown measure, colormap, ... */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no such values in it */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such values: errors of a run without distance queries, another object, ... */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    heatmap_ply: {
        parameters: {
            query: {
                /** @description Algorithm id (ignored for density). */
                algorithm: string;
                /** @description Which object. */
                side?: components["schemas"]["Side"];
                /** @description What to show. */
                measure: components["schemas"]["Measure"];
                /** @description Which statistic. */
                statistic: components["schemas"]["Statistic"];
                /** @description What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped. */
                outliers?: components["schemas"]["Outliers"];
                /** @description Show the difference to this algorithm: the values of `algorithm` minus its values. */
                against?: string;
                /** @description Subtract the values of another run on the same object; of the same algorithm unless `against` names another one. */
                against_run?: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
                /** @description Colormap. */
                colormap?: "turbo" | "viridis" | "cividis" | "purple_orange";
                /** @description Scale. */
                scale?: "linear" | "log";
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The coloured mesh */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/octet-stream": number[];
                };
            };
            /** @description Unknown measure, colormap, ... */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no such values in it */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such values: errors of a run without distance queries, another object, ... */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    records_csv: {
        parameters: {
            query: {
                /** @description Algorithm id. */
                algorithm: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One line per configuration */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of this algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    records_parquet: {
        parameters: {
            query: {
                /** @description Algorithm id. */
                algorithm: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description One row per configuration */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.parquet": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of this algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    refine_run: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The updated run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run belongs to someone else */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not a preview, or not ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description It can no longer be run */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    repro_zip: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description recipe.json lists the files: configurations, answers, objects, and plugins under free licences */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/zip": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no configurations */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run has not ended, or was measured by a version that is too old */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many archives are being downloaded */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_selection: {
        parameters: {
            query: {
                /** @description Algorithm whose columns are meant where the selection names none. */
                algorithm: string;
                /** @description The selection, e.g. `time in [500us, 15ms] & bv of parry in [1200, 35000] & near(vertex 8367, 0.05)`. */
                where: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Selected"];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of an algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The selection is not valid or cannot be applied */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_vertex: {
        parameters: {
            query: {
                /** @description Algorithm id (ignored for density). */
                algorithm: string;
                /** @description Which object. */
                side?: components["schemas"]["Side"];
                /** @description What to show. */
                measure: components["schemas"]["Measure"];
                /** @description Which statistic. */
                statistic: components["schemas"]["Statistic"];
                /** @description What to do with outliers [default: per_vertex, as on the page]. Of failures none is dropped. */
                outliers?: components["schemas"]["Outliers"];
                /** @description Show the difference to this algorithm: the values of `algorithm` minus its values. */
                against?: string;
                /** @description Subtract the values of another run on the same object; of the same algorithm unless `against` names another one. */
                against_run?: string;
                /** @description Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
                /** @description Vertex, from 0 */
                vertex: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["VertexValue"];
                };
            };
            /** @description Unknown measure, statistic, ... */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, values or vertex */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such values: errors of a run without distance queries, another object, ... */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    change_run_visibility: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NewVisibility"];
            };
        };
        responses: {
            /** @description The updated run */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description The body or the address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run belongs to someone else, or a guest tries to publish */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body came too slowly */
            408: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An object or plugin of the run is less visible */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The content type of the body is not JSON */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    witnesses_arrow: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description distance, triangle_a, triangle_b, a_x .. b_z */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.arrow.stream": number[];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no configurations yet */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_worst: {
        parameters: {
            query: {
                /** @description Algorithm id. */
                algorithm: string;
                /** @description What counts as worse, after wrong answers, which always come first. */
                by?: "time" | "error";
                /** @description How many at most, 1 to 1000 [default: 100]. */
                limit?: number;
                /** @description Only among the configurations of this selection. */
                where?: string;
            };
            header?: never;
            path: {
                /** @description Run id */
                id: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["WorstCase"][];
                };
            };
            /** @description The address cannot be read */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such run, or no records of this algorithm */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description No such list: errors of a run without distance queries, an invalid selection */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_stability: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["StabilityTable"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_status: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Status"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    show_suite: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SuiteInfo"];
                };
            };
            /** @description The token in `Authorization` is not valid */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
}
