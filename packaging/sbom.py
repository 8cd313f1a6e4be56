# SPDX-License-Identifier: MIT
"""Prints what the packages of a release need and contain, as SPDX 2.3: sbom.py VERSION FOLDER.

Read from the packages themselves: the fields Depends and Recommends of .deb files, Requires-Dist of wheels, dependencies
of npm archives; and of the libraries that wheels and npm archives have in them, the names of their licenses. Versions of these
are those of Debian's packages here, where the release is made. The time is SOURCE_DATE_EPOCH, so that the same packages give the same bytes.
"""
import datetime
import email
import hashlib
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from urllib.parse import quote


def debian_needs(path):
    fields = subprocess.run(["dpkg-deb", "-f", path, "Depends", "Recommends"], capture_output=True, text=True, check=True).stdout
    for line in fields.splitlines():
        for needed in line.split(":", 1)[1].split(","):
            yield "deb", re.split(r"[ :(|]", needed.strip())[0]


def wheel_needs(path):
    with zipfile.ZipFile(path) as wheel:
        metadata = next(name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
        for needed in email.message_from_bytes(wheel.read(metadata)).get_all("Requires-Dist", []):
            yield "pypi", re.match(r"[\w.-]+", needed)[0]


def npm_needs(path):
    with tarfile.open(path) as archive:
        package = json.load(archive.extractfile("package/package.json"))
    for kind in ("dependencies", "peerDependencies", "optionalDependencies"):
        for needed in package.get(kind, {}):
            yield "npm", needed


def wheel_contents(path):
    with zipfile.ZipFile(path) as wheel:
        for name in wheel.namelist():
            if found := re.search(r"/notices/([^/]+)\.txt$", name):
                yield found[1]


def npm_contents(path):
    with tarfile.open(path) as archive:
        if "package/bin/LICENSES.txt" in archive.getnames():
            licenses = archive.extractfile("package/bin/LICENSES.txt").read().decode()
            yield from re.findall(r"^==== (\S+) ====$", licenses, re.MULTILINE)


def debian_versions():
    """Returns versions of packages, and of the source packages that they are built from."""
    try:
        listed = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${source:Package} ${source:Version}\n"], capture_output=True, text=True)
    except FileNotFoundError:
        return {}
    versions = {}
    for line in listed.stdout.splitlines():
        package, source, version = line.split()
        versions[package] = versions[source] = version
    return versions


def purl(registry, name, version=None):
    """Returns a package URL; the @ of an npm scope, and : and + in versions, are percent-encoded."""
    place = "deb/debian" if registry == "deb" else registry
    return f"pkg:{place}/{quote(name, safe='/')}" + (f"@{quote(version, safe='')}" if version else "")


CONTENTS = {".whl": wheel_contents, ".tgz": npm_contents}
READERS = {".deb": debian_needs, ".whl": wheel_needs, ".tgz": npm_needs}


def spdx_id(*parts):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(parts))


def package(name, identifier, **more):
    return {"name": name, "SPDXID": identifier, "downloadLocation": "NOASSERTION", "filesAnalyzed": False, **more}


def main(version, folder):
    ours, needed, relations, versions = [], {}, [], debian_versions()
    for path in sorted(path for path in Path(folder).rglob("*") if path.is_file()):
        if path.name == "SHA256SUMS" or path.suffix == ".json":
            continue
        name = str(path.relative_to(folder))
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        ours.append(package(name, spdx_id(name), versionInfo=version, licenseDeclared="MIT",
                            checksums=[{"algorithm": "SHA256", "checksumValue": digest}]))
        relations.append(("SPDXRef-DOCUMENT", "DESCRIBES", spdx_id(name)))
        for registry, what in READERS.get(path.suffix, lambda _: ())(path):
            identifier = spdx_id(registry, what)
            needed[identifier] = package(what, identifier, externalRefs=[{
                "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                "referenceLocator": purl(registry, what)}])
            relations.append((spdx_id(name), "DEPENDS_ON", identifier))
        for what in CONTENTS.get(path.suffix, lambda _: ())(path):
            identifier = spdx_id("inside", what)
            release = versions.get(what) or versions.get(f"lib{what}")  # the package of zstd is libzstd
            needed[identifier] = package(what, identifier, **({"versionInfo": release} if release else {}), externalRefs=[{
                "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl("deb", what, release)}])
            relations.append((spdx_id(name), "CONTAINS", identifier))
    time = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    everything = hashlib.sha256("".join(one["checksums"][0]["checksumValue"] for one in ours).encode()).hexdigest()
    json.dump({
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"tspace-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/tspace-{version}-{everything}",
        "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: packaging/sbom.py"]},
        "packages": ours + [needed[one] for one in sorted(needed)],
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in sorted(set(relations))],
    }, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
