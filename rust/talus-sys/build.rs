// SPDX-License-Identifier: MIT
//
// Compiles the library from source: c/talus.c, all of it in one file, which a published crate carries (tools/amalgamate
// writes it), else the sources of the tree that this crate lies in.

use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        panic!("{}: neither c/talus.c nor the sources of the tree are there", folder.display());
    };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "c") {
            found.push(path);
        }
    }
}

fn main() {
    let here = PathBuf::from(std::env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let mut build = cc::Build::new();
    // Results are the same on every machine only without fused multiply-adds.
    build.std("c17").flag_if_supported("-ffp-contract=off").warnings(false);
    if std::env::var("OPT_LEVEL").as_deref() == Ok("0") {
        build.opt_level(1); // at 0 the inner loops are ten times slower, and nobody steps through them
    }
    let whole = here.join("c/talus.c");
    if whole.exists() {
        println!("cargo:rerun-if-changed=c");
        build.file(whole);
    } else {
        let tree = here.join("../..");
        let mut found = Vec::new();
        sources(&tree.join("src"), &mut found);
        found.sort();
        build.files(found).include(tree.join("include")).include(tree.join("src"));
        println!("cargo:rerun-if-changed={}", tree.join("src").display());
        println!("cargo:rerun-if-changed={}", tree.join("include").display());
    }
    build.compile("talus");
    println!("cargo:rerun-if-changed=build.rs");
}
