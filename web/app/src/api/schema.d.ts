// Generated from web/server/openapi.json by `npm run generate`: do not edit.
export interface paths {
    "/api/v1/algorithms": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** All algorithms. */
        get: operations["list_algorithms"];
        put?: never;
        post?: never;
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
    "/api/v1/objects": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** Stock objects, then the visitor's own, newest first. */
        get: operations["list_objects"];
        put?: never;
        /** Uploads an OBJ file; only its owner sees it in the list. */
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
    "/api/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** The visitor's runs, newest first. */
        get: operations["list_runs"];
        put?: never;
        /** Asks for a run. */
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
        delete?: never;
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
        /** Ends a run that is queued or at work; one that has ended stays as it is. */
        post: operations["cancel_run"];
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
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
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
             * @description Build time of both structures, milliseconds.
             */
            build_ms?: number | null;
            /**
             * Format: double
             * @description Mean BV tests per query.
             */
            bv_tests_mean?: number | null;
            class?: components["schemas"]["ContractClass"] | null;
            contacts?: components["schemas"]["ContactQuality"] | null;
            /** @description The answers that are not scored, because the configuration is narrower than the precision of the algorithm. */
            grazing?: components["schemas"]["Agreement"];
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
             * @description Rank by `ratio` within its class, from 1; algorithms whose intervals overlap are tied. Absent for what failed, gave a wrong answer or
             *     was measured in the development profile.
             */
            rank?: number | null;
            ratio?: components["schemas"]["Estimated"] | null;
            resolution?: components["schemas"]["Resolution"] | null;
            time?: components["schemas"]["TimeSummary"] | null;
            timing?: components["schemas"]["Timing"] | null;
            /** @description All answers by verdict (`correct`, `false_negative`, `gave_up`, ...); those that do not occur are left out. */
            verdicts: components["schemas"]["VerdictCount"][];
            /**
             * Format: int32
             * @description Wrong answers in all. Giving up and not supporting the question are none.
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
        /**
         * @description How a cell of the table looks: the gravest of what is in it.
         * @enum {string}
         */
        CellState: "agrees" | "slow" | "wrong" | "broken" | "unsupported" | "refused";
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
         * @description What an algorithm delivered, as its answers show.
         * @enum {string}
         */
        Delivered: "first_contact" | "all_contacts" | "distance" | "distance_with_witness";
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
         *     and was published when the run was asked for, before anything was measured.
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
            /** @description CPU model. */
            cpu: string;
            /**
             * Format: int32
             * @description CPUs.
             */
            cpus: number;
            /**
             * Format: int64
             * @description Times that stand although something disturbed the runner at every attempt.
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
            /** @description Expected seconds per algorithm. */
            measuring_seconds: components["schemas"]["AlgorithmSeconds"][];
            /**
             * Format: int32
             * @description Runs ahead in the queue.
             */
            runs_ahead: number;
            /**
             * Format: double
             * @description All together, without waiting.
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
            first?: components["schemas"]["Repro"] | null;
            /** @description The gravest of what was seen. */
            state: components["schemas"]["CellState"];
            /** @description Step by step, ascending. */
            steps: components["schemas"]["StepResult"][];
            /** @description All steps together. */
            tally: components["schemas"]["Tally"];
            /** @description Where it starts to fail: one for each side on which it does. */
            thresholds: components["schemas"]["ThresholdInfo"][];
        };
        /** @description Values on the vertices of an object. */
        Heatmap: {
            /** @description Values that went into each vertex after outlier removal. */
            counts: number[];
            /** @description Values that outlier removal took from each vertex. */
            dropped: number[];
            /**
             * Format: int32
             * @description Configurations that went in.
             */
            n: number;
            /** @description Smallest and largest value; absent when no vertex has one. */
            range?: number[] | null;
            /** @description What was asked. */
            request: components["schemas"]["HeatmapRequest"];
            /** @description Unit of the values (`ns`, `tests`, `configurations`). */
            unit: string;
            /** @description One per vertex, in the object's vertex order; null where there is none. */
            values: (number | null)[];
        };
        /** @description Which map; the query string of every heatmap route. */
        HeatmapRequest: {
            /** @description Algorithm id (ignored for density). */
            algorithm: string;
            /** @description What to show. */
            measure: components["schemas"]["Measure"];
            /** @description What to do with outliers. */
            outliers: components["schemas"]["Outliers"];
            /** @description Which object. */
            side?: components["schemas"]["Side"];
            /** @description Which statistic. */
            statistic: components["schemas"]["Statistic"];
        };
        /**
         * @description What to colour an object by.
         * @enum {string}
         */
        Measure: "time" | "bv_tests" | "primitive_tests" | "density";
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
            /** @description What was noticed and mended while reading (one sentence each). */
            warnings: string[];
        };
        /**
         * @description In which order configurations come.
         * @enum {string}
         */
        Order: "shuffled" | "trajectory";
        /** @description How a runner ended. */
        OutcomeInfo: {
            /** @description One sentence. */
            message: string;
            /** @description Name of the outcome as in the glossary, e.g. `Completed`, `TimedOut`, `SandboxFault`. */
            name: string;
            /** @description Our fault, never the plugin's. */
            ours: boolean;
        };
        /**
         * @description What happens to outliers: values outside Q1 - 1.5 IQR .. Q3 + 1.5 IQR.
         * @enum {string}
         */
        Outliers: "keep" | "per_vertex" | "global";
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
            first?: components["schemas"]["Repro"] | null;
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
        /** @description A question that fails, complete. */
        Repro: {
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
            /** @description Id (UUIDv7); whoever knows it may look. */
            id: string;
            /** @description Why it failed, one sentence. */
            message?: string | null;
            /** @description Made by the caller (may cancel). */
            mine: boolean;
            /** @description Name of object A. */
            object_a_name: string;
            /** @description Name of object B. */
            object_b_name: string;
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
        };
        /** @description What to measure. */
        RunSpec: {
            /**
             * @description Algorithm ids, each with its settings behind it (`box-tree:leaf_size=4`); the usual ones that answer the question when
             *     empty, every one that does for `["all"]`.
             */
            algorithms?: string[];
            /**
             * Format: double
             * @description Measuring time allowed per algorithm; a slower one is measured on as many configurations (taken in a shuffled
             *     order that all algorithms share) as fit.
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
             * @description Fresh processes, with one timed pass over the configurations each (1 to 99).
             */
            passes?: number;
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
            first?: components["schemas"]["Repro"] | null;
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
        /**
         * @description What counts as an object.
         * @enum {string}
         */
        Semantics: "surface" | "solid";
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
            /** @description SHA-256 (hex) of the stored set. */
            sha256: string;
            /**
             * Format: double
             * @description Distance between the nodes of the grid method.
             */
            spacing?: number | null;
        };
        /**
         * @description Which object of the scene.
         * @enum {string}
         */
        Side: "a" | "b";
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
            /** @description Maximum. */
            max_ns: components["schemas"]["Estimated"];
            /** @description Arithmetic mean; its interval is over the processes. */
            mean_ns: components["schemas"]["Estimated"];
            /** @description Median; its interval and the following ones are over the configurations. */
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
             * @description Blocks of questions that were disturbed and asked again, of all.
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
            /** @description Unit of the value (`ns`, `tests`, `configurations`). */
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
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
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
            /** @description No JSON */
            400: {
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
        };
    };
    list_objects: {
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
                    "application/json": components["schemas"]["ObjectInfo"][];
                };
            };
        };
    };
    add_object: {
        parameters: {
            query?: never;
            header?: never;
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
            /** @description No well-formed upload */
            400: {
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
            /** @description No usable OBJ file; says line and reason */
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
        };
    };
    list_runs: {
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
                    "application/json": components["schemas"]["RunInfo"][];
                };
            };
        };
    };
    start_run: {
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
            /** @description Queued; `Location` names it */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description No JSON */
            400: {
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
            /** @description The run as it is now */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunInfo"];
                };
            };
            /** @description Somebody else's run */
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
    show_ecdf: {
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
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Ecdf"];
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
            /** @description Last-Event-ID is no number */
            400: {
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
                /** @description What to do with outliers. */
                outliers: components["schemas"]["Outliers"];
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
            /** @description No such run, or no such values in it */
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
                /** @description What to do with outliers. */
                outliers: components["schemas"]["Outliers"];
                /** @description Colormap. */
                colormap?: "turbo" | "viridis" | "cividis";
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
            /** @description No such run, or no such values in it */
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
                /** @description What to do with outliers. */
                outliers: components["schemas"]["Outliers"];
                /** @description Colormap. */
                colormap?: "turbo" | "viridis" | "cividis";
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
            /** @description No such run, or no such values in it */
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
    records_csv: {
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
            /** @description One line per configuration */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": string;
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
    records_parquet: {
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
            /** @description One row per configuration */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/vnd.apache.parquet": number[];
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
                /** @description What to do with outliers. */
                outliers: components["schemas"]["Outliers"];
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
            /** @description No such run, values or vertex */
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
        };
    };
}
