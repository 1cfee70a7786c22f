#!/usr/bin/env bash
# Uses pages in a browser as a reader does; 77 where there is no browser or no node.  Usage: tests/page/run.sh folder
set -euo pipefail
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [[ -z $chromium ]] || ! command -v node >/dev/null; then
  echo "skipped: chromium and node are needed" && exit 77
fi
exec node "$(dirname "${BASH_SOURCE[0]}")/page.mjs" "$chromium" "$1"
