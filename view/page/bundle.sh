#!/usr/bin/env bash
# Bundles the page of a run, its style and the libraries that package-lock.json names into page.html, with their
# licences. To be run, and its result committed, after a change of src/.  Usage: view/page/bundle.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

npm ci --silent --no-audit --no-fund --ignore-scripts
node bundle.mjs
