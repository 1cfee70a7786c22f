"""The report of the benchmarks names what is missing, marks what is wrong, and is well-formed: report.py <report.py>."""

import html.parser
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop()
VOID = {"meta", "link", "br", "img", "input", "hr"}
EXTREMES = """case,parameter,stepper,outcome,error,steps,run_time_s,limit,varied
strong-drag,1e+01,ida,ok,1.0e-09,100,1.0e-03,1.0e-07,"drag of a bob, in water [kg/s]"
strong-drag,1e+02,ida,missed,2.0e-07,100,1.0e-03,1.0e-07,"drag of a bob, in water [kg/s]"
strong-drag,1e+03,ida,ok,nan,100,1.0e-03,1.0e-07,"drag of a bob, in water [kg/s]"
"""


class Page(html.parser.HTMLParser):
    """Elements that are open, attributes `id`, and where scripts, styles and pictures come from."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.sources = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        self.sources += [attributes[name] for name in ("src", "href") if name in attributes and tag != "use"]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"</{tag}> closes another element"


def report(tables):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in tables.items():
            (pathlib.Path(folder) / name).write_text(text)
        subprocess.run([sys.executable, "-B", PROGRAM, folder, "--commit", "abc"], check=True, stdout=subprocess.DEVNULL)
        return (pathlib.Path(folder) / "index.html").read_text()


class Report(unittest.TestCase):
    def test_of_nothing_names_every_missing_table(self):
        text = report({})
        for name in ("work-precision", "models", "ratios", "scaling", "set-up", "extremes", "events", "modes", "pairs", "audit",
                     "certificates", "requests", "leave-out", "own-constraint", "sensitivity", "sweep"):
            self.assertIn(f"{name}.csv", text)
        self.assertIn("kernels.json", text)
        self.assertNotIn(">passes<", text)

    def test_names_what_a_benchmark_that_was_stopped_left_empty(self):
        text = report({"sweep.csv": "", "kernels.json": '{"benchmarks": [', "failures.txt": "sweep ended with status 143\n"})
        for name in ("sweep.csv", "kernels.json", "sweep ended with status 143"):
            self.assertIn(name, text)

    def test_is_well_formed_without_a_network(self):
        page = Page(report({"extremes.csv": EXTREMES}))
        self.assertEqual(page.open, [])
        self.assertEqual(len(page.ids), len(set(page.ids)))
        self.assertFalse([source for source in page.sources if "//" in source])

    def test_marks_rows_beyond_their_limit_and_rows_without_a_number(self):
        text = report({"extremes.csv": EXTREMES})
        self.assertIn("2 are wrong.", text)
        self.assertIn(">FAILS<", text)
        self.assertEqual(text.count('<tr class="wrong">'), 4)  # by themselves, and among all

    def test_names_the_benchmarks_that_failed(self):
        self.assertIn("modes ended with status 139", report({"failures.txt": "modes ended with status 139\n"}))

    def test_says_which_run_was_refused(self):
        text = report({"models.csv": "model,notes,reference,t_end,stepper,tolerance,outcome\n"
                                     "cone,mex133,by hand,10,erk,1e-08,IntegrationFailure\n"})
        self.assertIn("IntegrationFailure", text)
        self.assertIn("cone-motion.svg", text)

    def test_text_of_a_table_is_no_markup(self):
        self.assertIn("gradient&lt;2&gt;", report({"kernels.json": '{"benchmarks": [{"name": "gradient<2>", '
                                                   '"real_time": 25.0, "time_unit": "ns"}]}'}))


unittest.main()
