"""Long work can be watched, stopped, and done beside other work."""

import signal
import subprocess
import sys
import threading
import unittest

import hysteron
from support import InFolder



class Stop(Exception):
    pass


class Interrupt(InFolder):
    def test_progress_may_stop_it(self):
        seen = []

        def stop(progress):
            seen.append(progress)
            raise Stop

        with self.assertRaises(Stop):
            hysteron.fit("data", "bouc-wen", solver="random-search", budget=10**9, progress=stop)
        self.assertEqual(len(seen), 1)
        self.assertEqual(seen[0].budget, 10**9)
        self.assertGreater(seen[0].evaluations, 0)
        with self.assertRaises(Stop):
            hysteron.diagnose("data", "bouc-wen", progress=stop)

    def test_progress_is_told_of_short_work_too(self):
        seen = []
        hysteron.fit("data", "viscous", budget=50, progress=seen.append)
        self.assertGreaterEqual(len(seen), 1)
        self.assertTrue(all(0 < one.share <= 1 for one in seen))

    def test_ctrl_c(self):
        for work in ("hysteron.fit('data', 'bouc-wen', solver='random-search', budget=10**9, progress=tell)",
                     "hysteron.diagnose('data', 'bouc-wen', progress=tell)"):
            script = (f"import hysteron\ndef tell(progress): print('under way', flush=True)\n"
                      f"try:\n    {work}\nexcept KeyboardInterrupt:\n    print('stopped')\n")
            child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                                     preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
            self.assertEqual(child.stdout.readline(), "under way\n")
            child.send_signal(signal.SIGINT)
            out, _ = child.communicate(timeout=240)
            self.assertEqual(child.returncode, 0)
            self.assertTrue(out.endswith("stopped\n"), out)

    def test_a_stopped_study_keeps_its_runs(self):
        (self.folder / "study.toml").write_text(
            'schema = "hysteron.study/1"\ntitle = "t"\nmodels = ["viscous"]\nsolvers = ["random-search"]\n'
            'budgets = [500]\nseeds = 200\ntargets = [1.1]\n[[data]]\nrecordings = "data"\nlabel = "d"\n')

        def stop(progress):
            raise Stop

        with self.assertRaises(Stop):
            hysteron.bench("study.toml", out="study", threads=1, progress=stop)
        found = len(hysteron.Study("study").runs)
        self.assertGreater(found, 0)
        self.assertEqual(len(hysteron.bench("study.toml", out="study").runs), 200)

    def test_two_at_a_time(self):
        # Each waits, in its first report, for the other to be under way: with the interpreter's lock held by one, the
        # other would never come.
        both = threading.Barrier(2, timeout=120)
        results = {}

        def work(name):
            waited = []

            def progress(_):
                if not waited:
                    waited.append(True)
                    both.wait()

            results[name] = hysteron.fit("data", "bingham", budget=2000, seed=5, threads=1, progress=progress)

        threads = [threading.Thread(target=work, args=(name,)) for name in ("one", "other")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertFalse(both.broken)
        self.assertEqual(results["one"].json, results["other"].json)


if __name__ == "__main__":
    unittest.main()
