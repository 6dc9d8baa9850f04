"""Only this machine by its own names, pages of the studio itself, and holders of the token get in."""

import pytest

from plisse.studio.gate import COOKIE, Gate, is_loopback

LOCAL, OPEN = Gate("127.0.0.1"), Gate("0.0.0.0", "secret")


@pytest.mark.parametrize("host", ["localhost:8080", "127.0.0.1:8080", "[::1]:8080", "localhost"])
def test_this_machine_is_let_in_by_its_names(host):
    assert LOCAL.refusal("/", {"Host": host}) is None
    assert LOCAL.refusal("/", {"Host": host, "Origin": f"http://{host}"}) is None


@pytest.mark.parametrize("host", ["evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", "192.168.0.7:80",
                                  "", "[", "evil.example@localhost:8080x", "0.0.0.0"])
def test_other_names_are_refused(host):
    assert "Host" in LOCAL.refusal("/", {"Host": host})


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://localhost:9999", "http://localhost",
                                    "https://evil.example/localhost:8080"])
def test_pages_of_other_sites_are_refused(origin):
    assert "Origin" in LOCAL.refusal("/", {"Host": "localhost:8080", "Origin": origin})


def test_the_token_opens_and_its_cookie_keeps_open():
    headers = {"Host": "192.168.0.7:8080"}
    assert "token" in OPEN.refusal("/", headers)
    assert "token" in OPEN.refusal("/?token=wrong", headers)
    assert OPEN.refusal("/?token=secret", headers) is None
    assert OPEN.is_given("/?token=secret")
    assert "HttpOnly" in OPEN.cookie
    assert "SameSite=Strict" in OPEN.cookie
    assert OPEN.refusal("/", {**headers, "Cookie": f"other=1; {COOKIE}=secret"}) is None
    assert OPEN.refusal("/", {**headers, "Cookie": f"{COOKIE}=wrong"}) is not None


def test_names_are_refused_with_a_token_too():
    assert "Host" in OPEN.refusal("/?token=secret", {"Host": "evil.example:8080"})


@pytest.mark.parametrize(("host", "local"), [("127.0.0.1", True), ("127.8.8.8", True), ("::1", True), ("localhost", True),
                                             ("0.0.0.0", False), ("192.168.0.7", False), ("studio.example", False)])
def test_loopback_is_known(host, local):
    assert is_loopback(host) == local
