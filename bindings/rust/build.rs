// SPDX-License-Identifier: MIT
//! Compiles the core library, which is one C++ file, and links it.
//!
//! The file is `native/tspace.cpp` in a package. In the repository `scripts/amalgamate` generates it here. The compiler
//! is given by `CXX_<target>` or `CXX`; default: `c++` (cross: `<prefix>-g++`). Requires GCC 12 or Clang 14, or newer.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{exit, Command};

fn fail(sentence: &str) -> ! {
    eprintln!("tspace: {sentence}");
    exit(1)
}

fn run(command: &mut Command, what: &str) {
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(_) => fail(&format!("{what} failed: {command:?}")),
        Err(error) => fail(&format!("{what}: cannot run {:?}: {error}", command.get_program())),
    }
}

fn var(name: &str) -> Option<String> {
    println!("cargo:rerun-if-env-changed={name}");
    env::var(name).ok().filter(|value| !value.is_empty())
}

/// Returns the variable `NAME_x86_64-unknown-linux-gnu`, `NAME_x86_64_unknown_linux_gnu` or `NAME`, like the crate cc.
fn for_target(name: &str, target: &str) -> Option<String> {
    var(&format!("{name}_{target}"))
        .or_else(|| var(&format!("{name}_{}", target.replace('-', "_"))))
        .or_else(|| var(name))
}

fn sources(out: &Path) -> PathBuf {
    let here = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let packaged = here.join("native");
    println!("cargo:rerun-if-changed={}", packaged.display());
    if packaged.join("tspace.cpp").exists() {
        return packaged;
    }
    let root = here.join("../..");
    let script = root.join("scripts/amalgamate");
    if !script.exists() {
        fail("native/tspace.cpp is missing: it is part of the package, and scripts/rust of the repository makes it");
    }
    for inside in ["src/core", "include/tspace", "scripts/amalgamate"] {
        println!("cargo:rerun-if-changed={}", root.join(inside).display());
    }
    let made = out.join("native");
    run(Command::new("python3").arg(&script).arg(&made), "making the two files");
    made
}

/// Returns the default compiler and archiver. Without CXX, the GNU cross compiler is used for other targets.
fn default_tools(target: &str, host: &str) -> (String, String) {
    if target == host {
        return ("c++".into(), "ar".into());
    }
    let prefix = match target {
        "x86_64-pc-windows-gnu" => "x86_64-w64-mingw32".to_string(),
        _ => target.replace("-unknown-", "-"),
    };
    let compiler = if target.ends_with("-windows-gnu") { "g++-posix" } else { "g++" };
    (format!("{prefix}-{compiler}"), format!("{prefix}-ar"))
}

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let (target, host) = (env::var("TARGET").unwrap(), env::var("HOST").unwrap());
    if target.ends_with("-msvc") {
        fail("MSVC does not compile tspace.cpp; take the target x86_64-pc-windows-gnu");
    }
    if env::var("DOCS_RS").is_ok() {
        return; // building documentation needs no library
    }
    let (compiler, archiver) = default_tools(&target, &host);
    let compiler = for_target("CXX", &target).unwrap_or(compiler);
    let archiver = for_target("AR", &target).unwrap_or(archiver);
    let folder = sources(&out);
    let object = out.join("tspace.o");
    let library = out.join("libtspace_core.a");

    // "ccache c++" is a program with an argument.
    let mut words = compiler.split_whitespace();
    let mut compile = Command::new(words.next().unwrap_or("c++"));
    compile.args(words).args(["-c", "-O2", "-std=c++20", "-w"]);
    if !target.contains("windows") {
        compile.arg("-fPIC");
    }
    if let Some(flags) = for_target("CXXFLAGS", &target) {
        compile.args(flags.split_whitespace());
    }
    compile.arg(folder.join("tspace.cpp")).arg("-o").arg(&object);
    run(&mut compile, "compiling tspace.cpp");
    let _ = std::fs::remove_file(&library);
    run(Command::new(&archiver).arg("crs").arg(&library).arg(&object), "making the static library");

    println!("cargo:rustc-link-search=native={}", out.display());
    println!("cargo:rustc-link-lib=static=tspace_core");
    let runtime = if target.contains("apple") { "c++" } else { "stdc++" };
    println!("cargo:rustc-link-lib={}", var("CXXSTDLIB").as_deref().unwrap_or(runtime));
    println!("cargo:include={}", folder.display());
}
