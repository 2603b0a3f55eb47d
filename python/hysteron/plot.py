"""Plots by matplotlib: loops, force against time, convergence. Each returns the axes drawn on."""

import numpy

from .recordings import as_recordings

MEASURED = {"color": "0.55", "linewidth": 1.5}
SIMULATED = {"color": "C3", "linewidth": 1.0}


def axes_or_new(axes):
    if axes is not None:
        return axes
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots(layout="constrained")[1]


def force_unit(recordings):
    """kN where forces are large, else N."""
    largest = max(numpy.abs(one.force).max() for one in recordings)
    return (1e-3, "kN") if largest >= 2000 else (1.0, "N")


def loops(recordings, model=None, over="displacement", axes=None):
    """Force over displacement or velocity, measured and, with a model, simulated."""
    if over not in ("displacement", "velocity"):
        raise ValueError(f"over: {over!r} is wrong, expected 'displacement' or 'velocity'")
    recordings = as_recordings(recordings, need_force=True)
    axes = axes_or_new(axes)
    scale, unit = force_unit(recordings)
    for k, one in enumerate(recordings):
        x = 1e3 * getattr(one, over)
        axes.plot(x, scale * one.force, label="measured" if k == 0 else None, **MEASURED)
        if model is not None:
            axes.plot(x, scale * model.simulate(one), label="simulated" if k == 0 else None, **SIMULATED)
    axes.set_xlabel("displacement [mm]" if over == "displacement" else "velocity [mm/s]")
    axes.set_ylabel(f"force [{unit}]")
    if model is not None:
        axes.legend()
    return axes


def force_time(recording, model=None, axes=None):
    """Force against time of one recording, measured and, with a model, simulated."""
    recordings = as_recordings(recording, need_force=True)
    if len(recordings) != 1:
        raise ValueError(f"force_time: {len(recordings)} recordings given, expected one")
    one = recordings[0]
    axes = axes_or_new(axes)
    scale, unit = force_unit(recordings)
    axes.plot(one.time, scale * one.force, label="measured", **MEASURED)
    if model is not None:
        axes.plot(one.time, scale * model.simulate(one), label="simulated", **SIMULATED)
        axes.legend()
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"force [{unit}]")
    axes.set_title(one.file)
    return axes


def convergence(model, axes=None):
    """Best NRMSE against evaluations of every solver that a fit compared."""
    traces = model.convergence
    if not traces:
        raise ValueError("convergence: the model was read from a file, expected one that fit has returned")
    axes = axes_or_new(axes)
    for solver, trace in traces.items():
        axes.step(trace[:, 0], trace[:, 1], where="post", label=solver)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("evaluations")
    axes.set_ylabel("best NRMSE")
    axes.legend()
    return axes
