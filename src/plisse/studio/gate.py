"""Who may talk to the studio: requests to this machine by name, from pages of this studio, with the token if one is set."""

import hmac
import ipaddress
from collections.abc import Mapping
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

__all__ = ["COOKIE", "Gate", "is_loopback"]

COOKIE = "plisse-token"
LOCAL = ("localhost", "127.0.0.1", "::1")


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches an interface."""
    try:
        return host == "localhost" or ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


@dataclass(frozen=True)
class Gate:
    """The rules for a studio on `host`; `token` is None on the loopback interface.

    Names are what pages of other sites could make a browser resolve to this machine (DNS rebinding), so the only names
    that are let in are localhost and the host as it was given; addresses are let in where there is a token.
    """

    host: str
    token: str | None = None

    def refusal(self, path: str, headers: Mapping[str, str]) -> str | None:
        """Why a request is refused, in a sentence; None where it is let in."""
        host = headers.get("Host", "")
        if not self._is_ours(host):
            return "The Host header names another machine."
        origin = headers.get("Origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return "The Origin header names another site."
        if self.token is not None and not self._has_token(path, headers):
            return "The token is missing or wrong; use the address that plisse studio printed."
        return None

    def is_given(self, path: str) -> bool:
        """Whether the address itself carries the token, to be kept in a cookie."""
        given = parse_qs(urlsplit(path).query).get("token", [""])[0]
        return self.token is not None and hmac.compare_digest(given.encode(), self.token.encode())

    @property
    def cookie(self) -> str:
        """The header that lets a browser keep the token."""
        return f"{COOKIE}={self.token}; HttpOnly; SameSite=Strict; Path=/"

    def _is_ours(self, netloc: str) -> bool:
        try:
            name = "" if "@" in netloc else urlsplit(f"//{netloc}").hostname or ""
        except ValueError:
            return False
        if name in LOCAL or (name == self.host.lower() and name):
            return True
        try:
            ipaddress.ip_address(name)
        except ValueError:
            return False
        return self.token is not None

    def _has_token(self, path: str, headers: Mapping[str, str]) -> bool:
        if self.is_given(path):
            return True
        try:
            kept = SimpleCookie(headers.get("Cookie", "")).get(COOKIE)
        except CookieError:
            return False
        return kept is not None and hmac.compare_digest(kept.value.encode(), str(self.token).encode())
