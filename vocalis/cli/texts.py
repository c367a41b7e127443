"""Texts of `vocalis --help`, kept apart from the physics, which is slow to import."""

PURPOSE = (
    "Five laryngeal muscles → posture of the vocal folds → vibration → flow → sound. "
    "Everything runs on this machine; no server is needed."
)

COMMANDS = {
    "posture": "Posture of the folds for five muscle activations: strain, glottal angle, tension.",
    "static": "Static shape of the folds without air pressure, and how they close.",
    "simulate": "Vibration at a constant posture: measures, waveforms, sound.",
    "gesture": "Vibration while the muscles move: glides, onsets, contours.",
    "sweep": "Many simulations over one to three parameters: a table of measures, as netCDF or CSV.",
    "serve": "The dashboard and the HTTP API on this machine.",
    "paper": "The claims of the paper, tested and scored.",
    "norms": "The voice compared with published norms of men.",
    "bench": "Speed of Vocalis on this machine.",
}

EPILOG = """
**The muscles**, each from 0 (relaxed) to 1 (full), with the modal voice as default:

- `--ta` thyroarytenoid: shortens the folds and bulges them medially
- `--ct` cricothyroid: lengthens and tenses them, the pitch muscle
- `--lca` lateral cricoarytenoid: turns the vocal processes inward
- `--ia` interarytenoid: closes the back of the glottis
- `--pca` posterior cricoarytenoid: the only opener

**Units** are SI: pressure in Pa (98 Pa = 1 cmH₂O), angles in rad, times in s.

**Examples**

- `vocalis posture --ct 0.8` — how much CT lengthens the folds
- `vocalis static --ta 0.6` — where they touch before any air flows
- `vocalis simulate --preset breathy --wav breathy.wav` — hear it
- `vocalis simulate --pressure 800 --vowel i --json > result.json` — every measure, for a script
- `vocalis sweep --axis activation.ct=0:1:21 --axis activation.ta=0:1:21 --netcdf map.nc` — a map over two muscles
- `vocalis simulate --variant human --coupling two_way --pressure 600` — a voice of human size
- `vocalis simulate --set constants.K_col_pa_m=2e6` — any constant of the model

Exit codes: 0 done, 1 the model has no answer there, 2 invalid input.
"""
