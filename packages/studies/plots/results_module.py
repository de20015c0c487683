# The module mortise_results from its text, the first argument: an isolated python finds no file of ours.
import types

mortise_results = types.ModuleType("mortise_results")
sys.modules["mortise_results"] = mortise_results
exec(compile(sys.argv.pop(1), "mortise_results.py", "exec"), mortise_results.__dict__)
