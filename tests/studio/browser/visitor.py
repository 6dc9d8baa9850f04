"""A person at the studio: a browser tab, and what one does in it with mouse and keyboard."""

import io
import os
import time
from pathlib import Path

import numpy as np
from PIL import Image

from plisse.io.design_text import design_text
from plisse.io.designs import design_from_dict

PICTURES = os.environ.get("PLISSE_PICTURES")
NOTES = ".mantine-Notification-closeButton"


class Visitor:
    """A tab on a studio; all errors of its console and all addresses that are not the studio's are kept."""

    def __init__(self, browser, studio, width=1300, height=900):
        known = set(studio.tabs)
        self.page = browser.new_page(viewport={"width": width, "height": height}, accept_downloads=True)
        self.errors, self.foreign = [], []
        self.page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", lambda request: self._note(request.url, studio.port))
        self.page.add_init_script(f"window.plisseSmooth = {'true' if PICTURES else 'false'}")
        self.page.goto(f"http://localhost:{studio.port}/")
        self.wait_for("exact")
        self.tab_behind = next(studio.tabs[number] for number in studio.tabs if number not in known)

    def leave(self):
        assert self.errors == [], self.errors
        assert self.foreign == [], self.foreign
        self.page.close()

    def _note(self, url, port):
        if not url.startswith((f"http://localhost:{port}/", f"ws://localhost:{port}", "data:", "blob:")):
            self.foreign.append(url)

    def wait_for(self, words, seconds=60):
        self.page.wait_for_function("words => document.body.innerText.includes(words)", arg=words, timeout=1000 * seconds)

    def tab(self, name):
        self.page.get_by_role("tab", name=name, exact=True).click()

    def button(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def fold_out(self, name):
        self.page.get_by_text(name, exact=True).click()

    def slide(self, name, *keys):
        self.page.get_by_role("slider", name=name, exact=True).focus()
        for key in keys:
            self.page.keyboard.press(key)

    def number(self, name):
        return float(self.page.get_by_role("slider", name=name, exact=True).get_attribute("aria-valuenow"))

    def choose(self, name, option):
        self.page.get_by_label(name, exact=True).click()
        self.page.get_by_role("option", name=option, exact=True).click()

    def tick(self, name):
        self.page.get_by_role("checkbox", name=name, exact=True).click()

    def write(self, name, text):
        box = self.page.get_by_label(name, exact=True)
        box.fill(text)
        box.press("Tab")

    @property
    def status(self):
        return self.page.locator("#plisse-status").inner_text()

    @property
    def text(self):
        """The design as TOML, as the browser has it."""
        self.tab("Take away")
        box = self.page.get_by_label("design (TOML)")
        until(lambda: box.input_value() == self.tab_behind.desk.toml)
        return box.input_value()

    def download(self, kind):
        self.tab("Take away")
        self.choose("format", kind)
        with self.page.expect_download(timeout=120_000) as waiting:
            self.button("Download")
        return waiting.value.suggested_filename, Path(waiting.value.path()).read_bytes()

    def read(self, recipe):
        """Give the studio a design as text."""
        self.tab("Take away")
        self.page.get_by_label("design (TOML)").fill(design_text(design_from_dict(recipe), title=""))
        self.button("Read the text above")

    def upload(self, file):
        with self.page.expect_file_chooser() as chooser:
            self.button("Upload a mesh …")
        chooser.value.set_files(file)

    def node(self, name):
        """A node of the scene, None where there is none of that name."""
        return self.tab_behind.client.scene._handle_from_node_name.get(name)

    def place_of(self, point):
        """Where on the page a point of the scene is."""
        camera = self.tab_behind.client.camera
        ahead = (camera.look_at - camera.position) / np.linalg.norm(camera.look_at - camera.position)
        right = np.cross(ahead, camera.up_direction)
        right /= np.linalg.norm(right)
        offset = np.asarray(point) - camera.position
        scale = camera.image_height / 2 / np.tan(camera.fov / 2) / (offset @ ahead)
        return (float(camera.image_width / 2 + scale * (offset @ right)),
                float(camera.image_height / 2 - scale * (offset @ np.cross(right, ahead))))

    def seen(self):
        """The pixels (H, W, 3) of the page."""
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB"))

    def rest(self):
        """Wait until the camera has come to its place."""
        places = [None]

        def is_still():
            time.sleep(0.3)
            places.append(tuple(self.tab_behind.client.camera.position))
            return places[-1] == places[-2]

        until(is_still)

    def picture(self, name):
        """Write a picture for the docs, where PLISSE_PICTURES says so."""
        if PICTURES:
            self._tidy()
            Image.fromarray(self.seen()).quantize(128).save(Path(PICTURES) / name, optimize=True)

    def frame(self, frames):
        """Keep a picture for a recording, where PLISSE_PICTURES says so."""
        if PICTURES:
            if not frames:
                self._tidy()
            frames.append(Image.fromarray(self.seen()).resize((780, 540)).quantize(64))

    def _tidy(self):
        self.page.evaluate(f"document.querySelectorAll('{NOTES}').forEach(button => button.click())")
        time.sleep(1.5)


def record(frames, name):
    """Write a recording for the docs, where PLISSE_PICTURES says so."""
    if PICTURES and frames:
        frames[0].save(Path(PICTURES) / name, save_all=True, append_images=frames[1:], duration=180, loop=0, optimize=True)


def until(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this did not happen in time"
        time.sleep(0.03)
