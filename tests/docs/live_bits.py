#!/usr/bin/env python3
"""The module of the live figures, run by a headless Chromium, and a program compiled from the same sources build the same
trees and give the same answers, bit for bit. Prints a line per builder that does not; exit code 77: no browser.

Run: live_bits.py PROGRAM MODULE"""

import base64
import pathlib
import subprocess
import sys

from chromium import Chromium, fault, finish

program, module = sys.argv[1], pathlib.Path(sys.argv[2])
seed, rays = "1", "100000"
ours = subprocess.run([program, seed, rays], check=True, capture_output=True, text=True).stdout.splitlines()
chromium = Chromium()
chromium.driver.get("about:blank")
answer = chromium.driver.execute_async_script("""
    const [text, seed, rays, done] = arguments, bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), nothing = {};
    (async () => {
        const module = await WebAssembly.compile(bytes);
        for (const {module: from, name} of WebAssembly.Module.imports(module)) (nothing[from] ??= {})[name] = () => 0;
        const {exports: code} = await WebAssembly.instantiate(module, nothing);
        code._initialize();
        const size = code.same_bits(Number(seed), Number(rays));
        return new TextDecoder().decode(new Uint8Array(code.memory.buffer, code.answer_bytes(), size));
    })().then(done, (fault) => done(String(fault)));""", base64.b64encode(module.read_bytes()).decode(), seed, rays)
chromium.driver.quit()
pages = answer.splitlines()
if len(ours) != len(pages) or not ours:
    fault("the module", f"answers {answer[:200]!r}")
for our, page in zip(ours, pages):
    if our != page:
        fault("the program", our)
        fault("the module", page)
finish(f"{len(ours)} builders, {rays} rays")
