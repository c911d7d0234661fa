# The manual pages name what there is, and nothing else: functions as hrad.h and hrad_mpi.h declare
# them, their constants and fields; commands, options, parameters and built-in scenes as the tool tells
# them; exit codes as the README does; references to pages that exist.
import os
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = os.environ["HRAD_SOURCE_DIR"]
HRAD = os.environ["HRAD"]
MAN = os.path.join(ROOT, "man")


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def tool(*arguments):
    return subprocess.run([HRAD, *arguments], check=True, stdout=subprocess.PIPE).stdout.decode()


class Page:
    """A page of mdoc: its sections, and the arguments of its macros."""

    def __init__(self, text):
        self.text = "".join(line + "\n" for line in text.splitlines() if not line.startswith('.\\"'))
        parts = re.split(r"^\.Sh (.*)$", self.text, flags=re.M)
        self.sections = dict(zip(parts[1::2], parts[2::2]))

    def section(self, name):
        return self.sections.get(name, "")


def all_pages():
    """Name with section -> page, hrad-params(7) as the build makes it."""
    pages = {}
    for name in sorted(os.listdir(MAN)):
        if re.search(r"\.[1-9]$", name):
            pages[name] = Page(read("man/" + name))
    with tempfile.TemporaryDirectory() as folder:
        made = os.path.join(folder, "hrad-params.7")
        subprocess.run(["sh", os.path.join(MAN, "params_page.sh"), HRAD,
                        os.path.join(MAN, "hrad-params.7.in"), made], check=True)
        with open(made, encoding="utf-8") as file:
            pages["hrad-params.7"] = Page(file.read())
    return pages


PAGES = all_pages()
# Pages of section 3 on the whole of the functions.
NO_FUNCTIONS = ("libhrad", "hrad-fortran")
FUNCTION_PAGES = {name: page for name, page in PAGES.items() if name.endswith(".3")}


def macros(text, name):
    """The arguments of every line of this macro, quotes and punctuation set apart taken off."""
    lines = re.findall(rf"^\.{name} (.*)$", text, re.M)
    return [[word for word in shlex.split(line) if word not in (",", ";", ":", ".", "(", ")")]
            for line in lines]


def squeezed(prototype):
    """C text without blanks that don't matter."""
    return re.sub(r"\s*([(),*;])\s*", r"\1", " ".join(prototype.split()))


# ---- what the header, the tool and the README tell


def header():
    text = read("include/hrad/hrad.h") + read("include/hrad/hrad_mpi.h")
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def declared_functions():
    """Name -> prototype."""
    found = re.findall(r"\bHRAD_API\s+([^;(]*?\b(hrad_\w+)\s*\([^)]*\))\s*;", header())
    return {name: squeezed(prototype) for prototype, name in found}


def declared_constants():
    constants = set(re.findall(r"#define (HRAD_VERSION_\w+)", header()))
    for body in re.findall(r"\benum\s*\{(.*?)\}", header(), re.S):
        constants.update(re.findall(r"\b(HRAD_\w+)\s*=", body))
    return constants


def declared_fields():
    """(struct, field) of every struct."""
    fields = set()
    for body, struct in re.findall(r"typedef struct \w+ \{(.*?)\}\s*(\w+);", header(), re.S):
        for declaration in filter(str.strip, body.split(";")):
            for name in declaration.split(","):
                fields.add((struct, re.search(r"(\w+)(\[\d+\])*\s*$", name).group(1)))
    return fields


def commands():
    listed = tool("--help").split("Commands:")[1].split("\n\n")[0]
    return re.findall(r"^  (\w+) ", listed, re.M)


def options_of(command):
    """The options of a command, long and short, with their dashes, and all its words."""
    listed = tool(command, "--help").split("Options:")[1].split("\n\n")[0]
    heads = re.findall(r"^  (-\S+)", listed, re.M)
    return {option for head in heads for option in head.split(",")}


OPTIONS = {command: options_of(command) for command in commands()}


def parameters():
    return {line.split()[0] for line in tool("params").splitlines()[1:]}


# ---- what the pages tell


def documented_options(text):
    """The options of the .It lines of a text."""
    options = set()
    for words in macros(text, "It"):
        for before, word in zip(words, words[1:]):
            if before == "Fl":
                options.add("-" + word)
    return options


def mentioned_options(text):
    """Options anywhere in running text and in examples."""
    found = set(re.findall(r"\bFl (-?[a-z][a-z-]*)", text)) | set(
        re.findall(r"^\.(?:It|Op) .*?, Fl (-?[a-z-]+)", text, re.M))
    for first, second in re.findall(r"\bFl (\S+) \| (-[a-z-]+)", text):
        found |= {first, second}
    return {"-" + option for option in found}


def examples(page):
    """The command lines of a page, as lists of words."""
    text = page.text.replace("\\e\n", " ")
    lines = re.findall(r"^(?:\.Dl )?(hrad [a-z]+ .*)$", text, re.M)
    return [shlex.split(line) for line in lines]


class Commands(unittest.TestCase):
    def test_hrad_1_lists_the_commands(self):
        text = PAGES["hrad.1"].section("DESCRIPTION").split(".El")[0]
        listed = [words[1] for words in macros(text, "It")]
        self.assertEqual(listed, commands())

    def test_every_command_has_a_page_and_no_page_lacks_a_command(self):
        pages = {name[5:-2] for name in PAGES if name.startswith("hrad-") and name.endswith(".1")}
        self.assertEqual(pages, set(commands()))

    def test_summaries_are_those_of_the_help(self):
        listed = tool("--help")
        text = PAGES["hrad.1"].section("DESCRIPTION").replace("\n.Pa .hrad\nfile:", " .hrad file:")
        for command in commands():
            summary = re.search(rf"^  {command} +(.*)$", listed, re.M).group(1)
            self.assertIn(f".It Cm {command}\n{summary}:\n.Xr hrad-{command} 1", text)


class Options(unittest.TestCase):
    common = documented_options(PAGES["hrad.1"].section("COMMON OPTIONS"))

    def test_pages_and_help_agree(self):
        for command, wanted in OPTIONS.items():
            page = PAGES[f"hrad-{command}.1"]
            documented = documented_options(page.section("OPTIONS")) | {"-h", "--help"}
            if "The common options" in page.text:
                self.assertFalse(documented & self.common, command)
                documented |= self.common
            self.assertEqual(documented, wanted, command)

    def test_common_options_are_for_the_commands_that_hrad_1_says(self):
        head = PAGES["hrad.1"].section("COMMON OPTIONS").split(".Bl")[0]
        named = {word for words in macros(head, "Cm") for word in words}
        takers = {command for command, options in OPTIONS.items() if self.common <= options}
        self.assertEqual(named, takers)
        self.assertEqual({command for command, options in OPTIONS.items()
                          if self.common & options}, takers)

    def test_synopses_show_every_option_of_their_own(self):
        for command in OPTIONS:
            page = PAGES[f"hrad-{command}.1"]
            own = documented_options(page.section("OPTIONS")) - {"-h", "--help"}
            self.assertEqual(mentioned_options(page.section("SYNOPSIS")), own, command)
            self.assertEqual(".Op Ar common options" in page.text,
                             "The common options" in page.text, command)

    def test_options_of_hrad_alone(self):
        listed = re.findall(r"^  (?:(-\w), )?(--\w+) ", tool("--help"), re.M)
        wanted = {option for pair in listed for option in pair if option}
        self.assertEqual(documented_options(PAGES["hrad.1"].section("OPTIONS")), wanted)

    def test_text_mentions_no_others(self):
        known = set().union(*OPTIONS.values()) | {"--version"}
        for name, page in PAGES.items():
            own = OPTIONS.get(name[5:-2], known) if name.endswith(".1") else known
            if name == "hrad-params.1":
                own = known  # tells where parameters are set
            self.assertLessEqual(mentioned_options(page.text) - own, set(), name)

    def test_examples_are_of_commands_and_their_options(self):
        count = 0
        for name, page in PAGES.items():
            for words in examples(page):
                count += 1
                self.assertIn(words[1], OPTIONS, f"{name}: {words}")
                used = {word for word in words[2:] if re.match(r"--?[a-z]", word)}
                self.assertLessEqual(used - OPTIONS[words[1]], set(), f"{name}: {words}")
        self.assertGreater(count, 20)


class Tables(unittest.TestCase):
    def test_parameters(self):
        page = PAGES["hrad-params.7"]
        rows = tool("params").splitlines()[1:]
        for kind in ("result", "run"):
            listed = [words[1] for words in macros(page.section(f"{kind.upper()} PARAMETERS"), "It")]
            wanted = [row.split()[0] for row in rows if re.search(rf" {kind}  ", row)]
            self.assertEqual(listed, wanted)

    def test_parameters_say_what_the_table_says(self):
        text = PAGES["hrad-params.7"].text
        for row in tool("params").splitlines()[1:]:
            name, kind, default = row.split()[:3]
            meaning = re.split(r" (?:result|run)  +", row)[1]
            entry = re.search(rf"^\.It Va {name}\n(.*)\n(.*)\n", text, re.M)
            self.assertEqual(entry.group(1), meaning)
            self.assertTrue(entry.group(2).endswith(f"; by default {default}."), entry.group(2))
            wanted = {"int": "A whole number from ", "double": "A number from "}.get(kind, "")
            self.assertTrue(entry.group(2).startswith(wanted), entry.group(2))

    def test_text_names_no_other_parameters(self):
        for name, page in PAGES.items():
            named = set(re.findall(r"^\.(?:It )?Va (\w+)", page.text, re.M))
            self.assertLessEqual(named - parameters(), set(), name)

    def test_built_in_scenes(self):
        rows = macros(PAGES["hrad-scene.5"].section("BUILT-IN SCENES"), "It")
        listed = [name for words in rows for name in words[1:]]
        self.assertEqual(sorted(listed), sorted(tool("scene", "--list").split()))

    def test_exit_codes_are_those_of_the_readme(self):
        section = PAGES["hrad.1"].section("EXIT STATUS")
        entries = re.findall(r"^\.It (.*)\n((?:(?!\.It|\.El).*\n)+)", section, re.M)
        # Marks and line ends aside, the words are the same.
        listed = [(code, " ".join(re.sub(r"^\.(?:Pa|Va) ", "", line)
                                  for line in text.splitlines())) for code, text in entries]
        table = read("README.md").split("## Exit codes")[1].split("\n\n")[1]
        rows = re.findall(r"^\| (\d+(?: \+ n)?) \| (.*) \|$", table, re.M)
        self.assertEqual(listed, [(code, text.replace("`", "")) for code, text in rows])
        self.assertGreater(len(rows), 10)


class Functions(unittest.TestCase):
    def test_each_is_named_on_exactly_one_page(self):
        named = [name for page in FUNCTION_PAGES.values()
                 for (name,) in macros(page.section("NAME"), "Nm")]
        self.assertEqual(sorted(named), sorted([*declared_functions(), *NO_FUNCTIONS]))

    def test_synopses_are_the_prototypes_of_the_header(self):
        for page_name, page in FUNCTION_PAGES.items():
            synopsis = page.section("SYNOPSIS")
            shown = {}
            for result, name, body in re.findall(
                    r"^\.Ft (.*)\n\.Fo (hrad_\w+)\n((?:\.Fa .*\n)+)\.Fc", synopsis, re.M):
                arguments = [argument.strip('"') for argument in re.findall(r"\.Fa (.*)", body)]
                result = result.strip('"')
                shown[name] = squeezed(f"{result} {name}({','.join(arguments)})")
            named = [name for (name,) in macros(page.section("NAME"), "Nm")]
            wanted = {name: declared_functions().get(name) for name in named if name not in NO_FUNCTIONS}
            self.assertEqual(shown, wanted, page_name)
            if wanted:
                self.assertEqual(list(shown), named, page_name)

    def test_sections_name_functions_that_are_there(self):
        for name, page in PAGES.items():
            named = set(re.findall(r"^\.Fn (\w+)", page.text, re.M))
            self.assertLessEqual(named - set(declared_functions()), set(), name)

    def test_each_is_explained_on_its_page(self):
        for page_name, page in FUNCTION_PAGES.items():
            for (name,) in macros(page.section("NAME"), "Nm"):
                if name not in (*NO_FUNCTIONS, "hrad_set_log"):  # the latter is all its page is about
                    self.assertIn(f"\n.Fn {name}", page.section("DESCRIPTION"), page_name)

    def test_constants(self):
        text = "".join(page.text for page in FUNCTION_PAGES.values())
        everywhere = "".join(re.sub(r"^\.Dt .*", "", page.text, flags=re.M)
                             for page in PAGES.values())
        self.assertEqual(declared_constants() - set(re.findall(r"\bHRAD_\w+", text)), set())
        named = set(re.findall(r"\bHRAD_[A-Z_]+", everywhere)) - {"HRAD_UNKNOWN"}
        self.assertEqual(named - declared_constants(), set())

    def test_fields_of_structs(self):
        for struct, field in declared_fields():
            pages = [page for page in FUNCTION_PAGES.values() if re.search(
                rf"\b{struct}\b", page.section("SYNOPSIS") + page.section("DESCRIPTION"))]
            self.assertTrue(any(re.search(rf"\b{field}\b", page.text) for page in pages),
                            f"{struct}.{field}")
        self.assertGreater(len(declared_fields()), 50)


class References(unittest.TestCase):
    def test_they_lead_to_pages(self):
        names = set(PAGES) | {f"{function}.3" for function in declared_functions()}
        for name, page in PAGES.items():
            for target, section in re.findall(r"\bXr (\S+) (\d)", page.text):
                self.assertIn(f"{target}.{section}", names, name)
                self.assertNotEqual(f"{target}.{section}", name)

    def test_see_also_is_in_order_and_no_page_is_lost(self):
        led_to = set()
        for name, page in PAGES.items():
            see = re.findall(r"^\.Xr (\S+) (\d)", page.section("SEE ALSO"), re.M)
            self.assertTrue(see, name)
            self.assertEqual(see, sorted(see, key=lambda entry: (entry[1], entry[0])), name)
            led_to |= {f"{target}.{section}" for target, section in see}
        self.assertEqual(set(PAGES) - led_to, set())

    def test_overviews_name_the_pages_of_their_section(self):
        for overview, ending in (("hrad.1", ".1"), ("libhrad.3", ".3")):
            wanted = {name[:-2] for name in PAGES if name.endswith(ending)} - {overview[:-2]}
            page = PAGES[overview]
            for part in (page.section("DESCRIPTION"), page.section("SEE ALSO")):
                named = set(re.findall(rf"\bXr (\S+) {ending[1]}", part)) - {"hrad", "libhrad"}
                self.assertEqual(named, wanted - {"hrad", "libhrad"}, overview)

    def test_pages_are_what_their_files_say(self):
        for name, page in PAGES.items():
            title, section = name.rsplit(".", 1)
            self.assertIn(f".Dt {title.upper()} {section}\n", page.text)
            for part in ("NAME", "DESCRIPTION"):
                self.assertIn(part, page.sections, name)
            if section in "13":
                self.assertIn("SYNOPSIS", page.sections, name)
            if section == "1":
                self.assertIn("EXIT STATUS", page.sections, name)
                self.assertIn("EXAMPLES", page.sections, name)

    def test_source_files_exist(self):
        for path in re.findall(r"\b(lib/[\w/.]+)", PAGES["hrad.7"].text):
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)


if __name__ == "__main__":
    unittest.main()
