"""mail_server.py PORT FOLDER MODE [CERTIFICATE KEY]: a mail server for tests, on the loopback interface until it is ended.

Each mail that it takes becomes FOLDER/<number>.json with its envelope, its head and its text; what it hears unencrypted is
added to FOLDER/clear. Modes:
  well         takes everything
  no-farewell  takes everything and never answers a farewell
  stranger     knows no receiver
  locked       takes only what "ada" with the password "s:cret" brings
  starttls     the same, encrypted from STARTTLS on
  tls          the same, encrypted from the first byte
"""

import asyncio
import email
import email.policy
import json
import pathlib
import ssl
import sys

from aiosmtpd.smtp import SMTP, AuthResult

PORT, FOLDER, MODE = int(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]


def is_encrypted(server):
    return server.transport.get_extra_info("sslcontext") is not None


class Server(SMTP):
    def data_received(self, data):
        if not is_encrypted(self):
            with open(FOLDER / "clear", "ab") as clear:
                clear.write(data)
        super().data_received(data)


class Keeper:
    async def handle_RCPT(self, server, session, envelope, address, options):
        if MODE == "stranger":
            return "550 5.1.1 nobody here has that name"
        envelope.rcpt_tos.append(address)
        return "250 OK"

    async def handle_DATA(self, server, session, envelope):
        mail = email.message_from_bytes(envelope.content, policy=email.policy.default)
        kept = {
            "encrypted": is_encrypted(server),
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
    how, context = {}, None
    if MODE in ("locked", "starttls", "tls"):
        how = {"authenticator": opened, "auth_required": True, "auth_require_tls": MODE == "starttls"}
    if MODE in ("starttls", "tls"):
        context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
        context.load_cert_chain(*sys.argv[4:])
    if MODE == "starttls":
        how |= {"tls_context": context, "require_starttls": True}
        context = None
    loop = asyncio.get_running_loop()
    server = await loop.create_server(lambda: Server(Keeper(), **how), "127.0.0.1", PORT, ssl=context)
    async with server:
        await server.serve_forever()


asyncio.run(serve())
