# SPDX-License-Identifier: MIT
"""Parses the declarations and comments of the public headers, in C++ and in C. Expects headers formatted by scripts/format;
it is not a general parser."""
import dataclasses
import re

# Both patterns match the name of a declaration as a group that is named like its kind.
KINDS = ("type", "enumerator", "constant", "callback", "function", "pointer", "field")
CPP = re.compile(r"""
    ^(?P<above>(?:\ *///(?!<).*\n)*)(?:\ *template\ <.*>\n)?
    (?!\ *(?:template|requires|friend|explicit|static_assert|using|struct\ \w+;|class\ \w+;)|.*\boperator\b|.*=\ delete)
    (?P<code>
        (?:enum\ class|struct|class)\ (?:\[\[nodiscard\]\]\ )?(?P<type>\w+)[^;{}]*\{
      | inline\ constexpr\ .*(?P<constant>k[A-Z]\w+)\ =[^;]*;
      | \ {4}(?P<enumerator>\w+)\ =\ \d+,?
      | \ {4}\w[^;={}()]*(?:\(\*(?P<pointer>\w+)\)\([^;]*|\ (?P<field>\w+)(?:\[\d+\])?(?:\ =\s+[^;]*|\{.*\})?);
      | (?:\ {4})?(?=[\w\[])[^;={}(]*?\b(?P<function>\w+)\([^;]*;
    )(?P<behind>\ *///<\ .*)?$""", re.X | re.M)
C = re.compile(r"""
    (?P<above>/\*(?:[^*]|\*(?!/))*\*/\n)?
    ^(?P<code>
        typedef\ (?:struct|uint32_t)\ (?P<type>tspace_\w+)(?:\ \{|[^{;]*;)
      | typedef\ [^;(]*\(\*(?P<callback>tspace_\w+)\)\([^;]*;
      | \w[\w\ *]*?(?P<function>tspace_\w+)\([^{};]*\)\ TSPACE_NOEXCEPT;
      | \#define\ (?P<constant>TSPACE_[A-Z_]+)\ (?:UINT\d+_MAX|0x\w+)
      | \ +(?P<enumerator>TSPACE_\w+)\ =\ \d+,?
      | \ {4}\w[\w\ *]*(?:\(\*(?P<pointer>\w+)\)\([^;]*|(?P<field>\b\w+)(?:,\ \w+)*(?:\[\d+\])?);
    )(?P<behind>\ */\*.*?\*/)?$""", re.X | re.M)


@dataclasses.dataclass
class Declaration:
    kind: str  # one of KINDS, or "method"
    name: str  # "Method::best", "TangentOptions::refine"; in C "TSPACE_METHOD_BEST", "tspace_TangentOptions.refine"
    owner: str  # the type that a member belongs to
    code: str
    comment: str
    start: int  # position of the comment, or of the code if there is none
    end: int
    header: str

    def member(self):
        """Returns the name without its type."""
        return re.split(r"::|\.", self.name)[-1]

    def indent(self):
        return len(self.code) - len(self.code.lstrip())

    def type(self):
        """Returns the C++ type of a field."""
        return re.split(r" \w+(?: =|\[|\{|;)", self.code, 1)[0].strip()

    def value(self):
        """Returns the number of an enumerator, or the C++ default of a field."""
        return re.search(r"(?: =\s+([^,;]*)[,;]?)?$", self.code)[1] or ""

    def paragraphs(self):
        """Splits a C++ comment into (names of parameters or "", text). A line starts a new paragraph if it describes a parameter,
        is empty or a formula, or if the previous line ends a sentence before the right margin."""
        made, before = [], ""
        for line in re.findall(r"^ *//[/ ]?<? ?(.*)", self.comment, re.M):
            parameter = re.match(r"((?:[a-z_]+, )*[a-z_]+) {2,}(\S.*)", line)
            names, text = made[-1] if made else ("", "")
            is_formula = line.startswith("    ") and not names
            has_room = len(before) + self.indent() + 5 + len(line.split(" ")[0]) <= 117 and before.endswith(".")
            if parameter:
                made.append(parameter.groups())
            elif line and not is_formula and (line.startswith("  ") or (text.strip() == text != "" and not names and not has_room)):
                made[-1] = names, f"{text} {line.strip()}"
            else:
                made.append(("", line))
            before = line
        return made


def cpp(text, header):
    """Returns the declarations of a C++ header, without constructors, bodies and private members."""
    text = re.sub(r"^ *private:\n.*?(?=^\};)", "", text, flags=re.M | re.S)
    text = re.sub(r" \{(?:\n(?:(?: {8}.*)?\n)* {4}|\n(?:(?: {4}.*)?\n)*| .* )?\}$", ";", text, flags=re.M)
    return [made for made in _declarations(CPP, one_per_line(text), "::", header) if made.member() != made.owner]


def c(text):
    """Returns the declarations of a C header."""
    return list(_declarations(C, text, "."))


def one_per_line(text):
    """Rewrites enumerations on a single line."""
    return re.sub(r"^(enum.*\{) (.*) \}", lambda found: f"{found[1]}\n    {found[2]}\n}}".replace(", ", ",\n    "), text, flags=re.M)


def _declarations(pattern, text, separator, header=""):
    owner = ""
    for found in pattern.finditer(text):
        kind, name = next((kind, found[kind]) for kind in KINDS if kind in pattern.groupindex and found[kind])
        owner = name if kind == "type" else owner
        is_member = found["code"].startswith(" ")
        is_qualified = is_member and (separator == "::" or kind != "enumerator")
        kind = {"pointer": "field", "function": "method" if is_member else "function"}.get(kind, kind)
        yield Declaration(kind, f"{owner}{separator}{name}" if is_qualified else name, owner if is_member else "", found["code"],
                          found["above"] or found["behind"] or "", found.start(), found.end(), header)
