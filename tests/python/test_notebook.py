"""The notebooks of examples/ run from beginning to end and are stored without outputs."""

import os
import pathlib
import sys
import unittest

try:
    import nbclient
    import nbformat
except ImportError:
    print("nbclient is not installed, the notebook is not run")
    sys.exit(77)

NOTEBOOKS = sorted((pathlib.Path(os.environ["HYSTERON_SOURCE_DIR"]) / "examples" / "notebook").glob("*.ipynb"))


class Notebooks(unittest.TestCase):
    def test_run(self):
        self.assertGreater(len(NOTEBOOKS), 0)
        for path in NOTEBOOKS:
            notebook = nbformat.read(path, as_version=4)
            nbformat.validate(notebook)
            for cell in notebook.cells:
                if cell.cell_type == "code":
                    self.assertEqual((cell.outputs, cell.execution_count), ([], None), f"{path.name} holds outputs")
            nbclient.NotebookClient(notebook, timeout=240, kernel_name="python3",
                                    resources={"metadata": {"path": str(path.parent)}}).execute()
            pictures = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs
                        if "image/png" in output.get("data", {})]
            self.assertGreater(len(pictures), 2)


if __name__ == "__main__":
    unittest.main()
