"""mail_server.py PORT FOLDER MODE: a mail server for tests, on the loopback interface until it is ended.

Each mail that it takes becomes FOLDER/<number>.json with its envelope, its head and its text. Modes:
  well         takes everything
  no-farewell  takes everything and never answers a farewell
  stranger     knows no receiver
  locked       takes only what "ada" with the password "s:cret" brings
"""

import asyncio
import email
import email.policy
import json
import pathlib
import sys

from aiosmtpd.smtp import SMTP, AuthResult

PORT, FOLDER, MODE = int(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]


class Keeper:
    async def handle_RCPT(self, server, session, envelope, address, options):
        if MODE == "stranger":
            return "550 5.1.1 nobody here has that name"
        envelope.rcpt_tos.append(address)
        return "250 OK"

    async def handle_DATA(self, server, session, envelope):
        mail = email.message_from_bytes(envelope.content, policy=email.policy.default)
        kept = {
            "from": envelope.mail_from,
            "to": envelope.rcpt_tos,
            "head": {name.lower(): str(value) for name, value in mail.items()},
            "fields": len(mail.items()),
            "text": mail.get_content().replace("\r\n", "\n"),
        }
        number = len(list(FOLDER.glob("*.json")))
        part = FOLDER / f"{number:04}.part"
        part.write_text(json.dumps(kept))
        part.rename(FOLDER / f"{number:04}.json")
        return "250 it is kept"

    async def handle_QUIT(self, server, session, envelope):
        if MODE == "no-farewell":
            await asyncio.sleep(3600)
        return "221 farewell"


def opened(server, session, envelope, mechanism, credentials):
    return AuthResult(success=(credentials.login, credentials.password) == (b"ada", b"s:cret"), handled=False)


async def serve():
    locked = {"authenticator": opened, "auth_required": True, "auth_require_tls": False} if MODE == "locked" else {}
    server = await asyncio.get_running_loop().create_server(lambda: SMTP(Keeper(), **locked), "127.0.0.1", PORT)
    async with server:
        await server.serve_forever()


asyncio.run(serve())
