"""Headless Chromium, Debian's package chromium, for scripts that are run by hand."""
import json, os, subprocess, sys, time


class Browser:
    """Chromium without a window, by its DevTools over a pipe: JSON texts, each with a zero behind it."""

    def __init__(self, folder):
        (theirs_in, self.out), (self.into, theirs_out) = os.pipe(), os.pipe()
        def pipes():  # Chromium reads from 3 and writes to 4
            os.dup2(theirs_in, 30), os.dup2(theirs_out, 31), os.dup2(30, 3), os.dup2(31, 4)
        self.process = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", "--user-data-dir=" + folder,
             "--window-size=1280,1000", "--enable-precise-memory-info", "about:blank"],
            preexec_fn=pipes, close_fds=False, stderr=subprocess.DEVNULL)
        os.close(theirs_in), os.close(theirs_out)
        self.rest, self.number, self.session = b"", 0, None
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]

    def ask(self, method, **parameters):
        self.number += 1
        text = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            text["sessionId"] = self.session
        os.write(self.out, json.dumps(text).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                more = os.read(self.into, 1 << 20)
                if not more:
                    sys.exit("Chromium ended")
                self.rest += more
            answer, self.rest = self.rest.split(b"\0", 1)
            answer = json.loads(answer)
            if answer.get("method") == "Runtime.exceptionThrown":
                sys.exit(answer["params"]["exceptionDetails"]["exception"].get("description", "a script threw"))
            if answer.get("id") == self.number:
                if "error" in answer:
                    sys.exit(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def value(self, expression):
        result = self.ask("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            sys.exit(f"{expression}: {result['exceptionDetails']['text']}")
        return result["result"].get("value")

    def until(self, expression, timeout_s=60):
        end = time.monotonic() + timeout_s
        while not self.value(f"document.readyState === 'complete' && ({expression})"):
            if time.monotonic() > end:
                sys.exit(f"after {timeout_s} s not yet: {expression}")
            time.sleep(0.02)

    def close(self):
        self.process.terminate()
        self.process.wait()
