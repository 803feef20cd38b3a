"""What the installed wheel does without any other Python package: measures, and says what is missing for the rest."""
import opencollbench

run = opencollbench.bench("stock:torus-knot@600", algorithms=["box-tree", "ocb-fast"], separation=0.1, count=200, passes=1, progress=False)
assert run.ok, run.info
assert [row["n"] for row in run.summary()] == [200, 200], run.info
try:
    run.records().to_pandas()
except opencollbench.MissingPackage as missing:
    assert "opencollbench[pandas]" in str(missing), missing
else:
    raise AssertionError("pandas is here, so this is not the empty environment that it should be")
print(f"dist: wheel: measured from Python\n{run}")
