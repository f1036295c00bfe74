#!/bin/sh
# sizes.sh ROOT: no function of more than 60 lines, braces counted, and no file of more than 320 lines in the product.
# Prints every breach; the status is 1 if there is one.
set -u
cd "$1" || exit 1
find app geometry sim render cases -name '*.[ch]' -o -name '*.[ch]pp' 2>/dev/null | sort | xargs awk '
    function end_file() {
        if (lines > 320) { print file ": " lines " lines"; bad = 1 }
    }
    FNR == 1 { end_file(); file = FILENAME; start = 0 }
    /^[{]$/ { start = FNR; name = before }
    /^[}]$/ && start {
        if (FNR - start >= 60) { print file ":" start ": " FNR - start + 1 " lines: " name; bad = 1 }
        start = 0
    }
    { before = $0; lines = FNR }
    END { end_file(); exit bad }' || exit 1
echo "functions and files are short"
