#!/bin/sh
# what_the_pages_promise_is_there: the program in README.md, the files and sections that README.md and docs/ link to
. tests/tap.sh

program_in_the_readme() {
    sed -n '/<!-- firmware -->/,/<!-- end -->/p' README.md | sed '1,2d;$d' | sed '$d' | diff port/minimal_main.c -
}
check "README.md shows the whole of port/minimal_main.c, which every target builds and runs" program_in_the_readme

# FILE LINK of each link to a place in the project; code is no text.
links() {
    awk '/^ *```/ { code = !code } code { next } {
        gsub(/`[^`]*`/, "")
        while (match($0, /\]\([^)]*\)/)) {
            link = substr($0, RSTART + 2, RLENGTH - 3)
            $0 = substr($0, RSTART + RLENGTH)
            if (link !~ /^[a-z]+:/)
                print FILENAME, link
        }
    }' README.md docs/*.md
}

# The anchors of a page's headings: lower case, no punctuation, hyphens for blanks; those of a heading that came before
# have -1, -2 at the end.
anchors() {
    awk '/^ *```/ { code = !code } !code && /^#+ / {
        sub(/^#+ /, "")
        $0 = tolower($0)
        gsub(/[^a-z0-9 _-]/, "")
        gsub(/ /, "-")
        print $0 (seen[$0]++ ? "-" seen[$0] - 1 : "")
    }' "$1"
}

# A path relative to the page, and a section after #.
broken_links() {
    links | while read -r page link; do
        path=${link%%#*}
        file=$(dirname "$page")/$path
        [ -n "$path" ] || file=$page
        if [ ! -e "$file" ]; then
            echo "$page: $link: no such file"
        elif [ "$link" != "$path" ] && ! anchors "$file" | grep -qxF -e "${link#*#}"; then
            echo "$page: $link: no such section"
        fi
    done
}

no_broken_links() {
    broken=$(broken_links)
    [ -z "$broken" ] || {
        echo "$broken"
        return 1
    }
}
check "there are links to look at" [ "$(links | wc -l)" -gt 30 ]
check "every link of README.md and docs/ leads to a file and a section that are there" no_broken_links
finish
