# shellcheck shell=bash
fetch_scenes() { die 1 "scenes: not written yet"; }
