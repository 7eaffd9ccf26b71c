"""A headless Chromium that looks at local files, for the tests of what the book makes for a browser: started with
start(), or the test is skipped (exit code 77). What is wrong is told by fault() and counted by finish()."""

import json
import pathlib
import shutil
import sys
import tempfile
import urllib.parse

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(77)

faults = []


def fault(where, what):
    faults.append(f"{where}: {what}")


class Chromium:
    def __init__(self):
        browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
        driver = shutil.which("chromedriver")
        if not browser or not driver:
            print("skipped: chromium or chromium-driver is not installed")
            sys.exit(77)
        options = webdriver.ChromeOptions()
        options.binary_location = browser
        self.profile = tempfile.TemporaryDirectory()
        for argument in (
            "--headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-background-networking "
            f"--disable-component-update --disable-sync --no-first-run --disable-ipc-flooding-protection --user-data-dir={self.profile.name}"
        ).split():
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(driver), options=options)
        self.driver.set_page_load_timeout(60)
        self.driver.set_script_timeout(300)
        self.size = self.media = None

    def run(self, script):
        return self.driver.execute_script(script)

    def wait(self, script, seconds=20):
        """Whether the expression becomes true in time."""
        try:
            WebDriverWait(self.driver, seconds, poll_frequency=0.05).until(lambda _: self.run("return " + script))
            return True
        except Exception:
            return False

    def command(self, name, **arguments):
        """A command of the DevTools protocol."""
        return self.driver.execute_cdp_cmd(name, arguments)

    def window(self, width, height=900, mode="light", media=""):
        """Only what changes is told: a page of a megabyte is laid out anew for each of the two."""
        if self.size != (width, height):
            self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 500)
        if self.media != (mode, media):
            self.command("Emulation.setEmulatedMedia", media=media, features=[dict(name="prefers-color-scheme", value=mode)])
        self.size, self.media = (width, height), (mode, media)

    def open(self, file, anchor=""):
        self.driver.get(pathlib.Path(file).resolve().as_uri() + anchor)

    def look_at_logs(self, where):
        """Nothing on the console, nothing asked of a network."""
        for entry in self.driver.get_log("browser"):
            if entry["level"] in ("SEVERE", "WARNING"):
                fault(where, "console: " + entry["message"])
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if urllib.parse.urlsplit(url).scheme not in ("file", "data", "blob", "about", "chrome", "chrome-untrusted"):
                    fault(where, f"asks the network for {url}")


def finish(looked_at):
    """Ends the test: a line per fault, and what was looked at."""
    for line in faults:
        print(line)
    print(f"{looked_at}: {len(faults)} faults")
    sys.exit(1 if faults else 0)
