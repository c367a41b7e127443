"""The pure parts of the page, run where they live: in the browser."""

import struct
from json import dumps

import numpy as np
import pytest

AXIS = "const axis = await import('/core/axis.js');"


def test_ticks_are_round_and_inside(modules):
    run = "async ([low, high, most]) => { " + AXIS + " return axis.ticks(low, high, most); }"
    assert modules(run, [0, 95, 4]) == [0, 25, 50, 75]
    assert modules(run, [-420, 3447, 4]) == [0, 1000, 2000, 3000]
    assert modules(run, [-0.3, 0.3, 4]) == pytest.approx([-0.2, 0, 0.2])


def test_an_axis_is_kept_while_the_data_fill_half_of_it(modules):
    run = "async ([before, data, options]) => { " + AXIS + " return axis.steadyLimits(before, data, options); }"
    first = modules(run, [None, {"min": 0, "max": 95}, {}])
    assert first == [0, 100]
    assert modules(run, [first, {"min": 0, "max": 60}, {}]) == first
    assert modules(run, [first, {"min": 0, "max": 130}, {}]) == [0, 150], "it grows at once"
    assert modules(run, [first, {"min": 0, "max": 30}, {}]) == [0, 30], "and shrinks when it is mostly empty"
    assert modules(run, [None, {"min": -480, "max": 460}, {"symmetric": True}]) == [-500, 500]
    assert modules(run, [None, {"min": -1e-9, "max": 1e-9}, {"symmetric": True, "least": 50}]) == [-50, 50]


def test_numbers_are_written_as_people_write_them(modules):
    run = "async ([value, decimals]) => { " + AXIS + " return axis.numberText(value, decimals); }"
    assert modules(run, [1291.7, 0]) == "1\u202f292"
    assert modules(run, [-0.0041, 3]) == "−0.004"
    assert modules(run, [-0.0001, 2]) == "0.00", "no minus before nothing"


def test_a_request_is_the_patch(modules):
    run = """async ([document, patch, defaults]) => {
      const params = await import("/core/parameters.js");
      const request = await import("/state/request.js");
      const schema = params.readSchema(document);
      request.begin(schema, [], patch, { basis: params.basisOf(schema, patch), values: defaults });
      const before = {
        run: params.simulationRequest(patch, { duration_s: 0.5 }),
        posture: params.postureRequest(patch),
        preset: request.preset.value?.key ?? null,
      };
      request.choosePreset("breathy");
      return { ...before, breathy: request.patch.value, chosen: request.preset.value.key };
    }"""

    def row(key, group="muscles", step=0.01, part=None):
        return {
            "key": key, "label": key, "symbol": "", "default": 0, "step": step, "group": group, "nullable": False,
            "optional_part": part,
        }  # fmt: skip

    document = {
        "parameters": [
            row("activation.ta"),
            row("activation.pca"),
            row("vowel", "tract", None),
            row("posture.strain", "posture", part="posture"),
            row("run.nx", "run", 1),
        ],
        "presets": [
            {"key": "modal", "request": {"activation": {"ta": 0.4, "pca": 0}}},
            {"key": "breathy", "request": {"activation": {"pca": 0.5}}},
        ],
        "vowels": [],
        "variants": [],
        "sides": [],
        "lists": [],
    }
    defaults = {"activation.ta": 0.4, "activation.pca": 0.0, "vowel": "a", "posture": None, "run.nx": 20}
    answer = modules(run, [document, {"activation.ta": 0.7, "run.nx": 30, "vowel": "i"}, defaults])
    assert answer["run"] == {
        "kind": "simulation", "activation": {"ta": 0.7}, "vowel": "i", "run": {"nx": 30, "duration_s": 0.5},
    }  # fmt: skip
    assert "run" not in answer["posture"] and answer["posture"]["activation"] == {"ta": 0.7}
    assert answer["preset"] is None
    kept = {"run.nx": 30, "vowel": "i"}
    assert answer["breathy"] == kept | {"activation.pca": 0.5}, "a preset leaves the vowel and the run alone"
    assert answer["chosen"] == "breathy"
    assert modules(run, [document, {"vowel": "i"}, defaults])["preset"] == "modal"
    assert modules(run, [document, {}, defaults | {"activation.pca": 0.5}])["preset"] == "breathy", (
        "by what is in force"
    )
    given = {"posture.strain": 0.1}
    assert modules(run, [document, given, defaults])["preset"] is None, "a posture given directly is no preset"


def test_one_request_is_in_flight_and_the_newest_wins(modules):
    run = """async () => {
      const { LatestOnly } = await import("/core/latest-only.js");
      const pending = [], log = [];
      let flying = 0, most = 0;
      const requests = new LatestOnly(
        (job) => {
          most = Math.max(most, ++flying);
          return new Promise((done, failed) => pending.push({ job, done, failed }));
        },
        (answer) => { flying--; log.push(answer); },
        (error) => { flying--; log.push(error); },
      );
      const tick = () => new Promise((done) => setTimeout(done));
      for (const job of [1, 2, 3, 4]) requests.push(job);
      pending[0].done("one"); await tick();
      requests.push(5); requests.push(6);
      pending[1].failed("four failed"); await tick();
      pending[2].done("six"); await tick();
      return { asked: pending.map(({ job }) => job), log, most };
    }"""
    assert modules(run) == {"asked": [1, 4, 6], "log": ["one", "four failed", "six"], "most": 1}


def test_a_reply_in_bytes_is_read_as_it_was_written(modules):
    values = {"flow": np.arange(6, dtype="<f4").reshape(2, 3), "area": np.array([0.5, -1], dtype="<f4")}
    table, offset = {}, 0
    for name, array in values.items():
        table[name] = {"offset": offset, "shape": list(array.shape), "unit": "m"}
        offset += array.nbytes
    header = dumps({"id": "ü", "arrays": table}).encode()
    header += b" " * (-len(header) % 4)
    reply = struct.pack("<I", len(header)) + header + b"".join(array.tobytes() for array in values.values())
    run = """async (reply) => {
      const { decodeResult } = await import("/core/api.js");
      const { header, arrays } = decodeResult(new Uint8Array(reply).buffer);
      return [header.id, arrays.flow.shape, Array.from(arrays.flow.data), Array.from(arrays.area.data)];
    }"""
    assert modules(run, list(reply)) == ["ü", [2, 3], [0, 1, 2, 3, 4, 5], [0.5, -1]]


def test_the_outline_is_the_distance_from_the_midline(modules):
    """A wedge of 16 mm by 4 mm half width, pressed over the midline inferiorly in one slice, superiorly in another."""
    run = """async ([x, medial, w]) => {
      const glottis = await import("/core/glottis.js");
      const fields = { nx: x.length, ny: 2, x, medial };
      return glottis.foldEdges(fields, w);
    }"""
    x = np.linspace(0, 16e-3, 5)
    medial = np.repeat(x / 4, 2)
    w = np.zeros(10)
    w[5] = medial[5] + 1e-3  # third slice, inferior
    w[2] = medial[2] + 5e-4  # second slice, superior
    answer = modules(run, [x.tolist(), medial.tolist(), w.tolist()])
    assert answer["u"] == pytest.approx([-16, -12, -8, -4, 0])
    assert answer["superior"] == pytest.approx([0, -0.5, 2, 3, 4])
    assert answer["inferior"] == pytest.approx([0, 1, -1, 3, 4])
    assert answer["inner"] == pytest.approx([0, -0.5, -1, 3, 4])


def test_the_flow_derivative_is_the_one_of_mfdr(modules):
    """A sine through the same Gaussian: slope ω, less what a low-pass with −3 dB at 3 kHz takes from it."""
    run = """async ([wave, rate]) => {
      const { slope } = await import("/features/waves/stack.js");
      return Array.from(slope(new Float32Array(wave), 500, 1500, rate));
    }"""
    rate = 35000
    t = np.arange(2000) / rate
    for hertz in (150, 3000):
        found = modules(run, [np.sin(2 * np.pi * hertz * t).tolist(), rate])
        kept = 2 ** (-0.5 * (hertz / 3000) ** 2)
        expected = 2 * np.pi * hertz * kept * np.cos(2 * np.pi * hertz * t[500:1501])
        assert np.abs(found - expected).max() < 0.01 * 2 * np.pi * hertz


@pytest.mark.parametrize("theme, grows", [("light", -1), ("dark", 1)])
def test_colour_maps_run_evenly_in_lightness(modules, theme, grows):
    run = "async ([name, theme]) => Array.from((await import('/core/colours.js')).colourTable(name, theme))"

    def luminance(name):
        rgb = np.array(modules(run, [name, theme])).reshape(256, 3) / 255
        return np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722]

    assert (grows * np.diff(luminance("sequential")) > -2e-3).all(), "no turning point that could be taken for a value"
    half = luminance("diverging")
    assert (grows * np.diff(half[128:]) > -2e-3).all() and (grows * np.diff(half[:128]) < 2e-3).all()
    assert abs(half[30] - half[225]) < 0.1, "both signs weigh the same"


def test_advice_fits_the_cause(modules):
    run = "async ([values, gap]) => (await import('/features/measures/texts.js')).hintFor(values, gap)"

    def advice(gap_mm, pressure=1000, **activation):
        muscles = {f"activation.{name}": 0.0 for name in ("ta", "ct", "lca", "ia", "pca")}
        muscles |= {f"activation.{name}": value for name, value in activation.items()}
        return modules(run, [muscles | {"subglottal_pressure_pa": pressure}, gap_mm])

    assert advice(9.9, pca=1, lca=0.8, ia=0.8) == "The vocal processes are 9.9 mm apart. Try less PCA."
    assert "more LCA and IA" in advice(5, lca=0.2, ia=0.9)
    assert advice(0, pressure=200, lca=1, ia=1) == "Try more lung pressure."
    assert "TA" in advice(0, ta=0.9, lca=1, ia=1)


def test_the_address_restores_the_settings(modules):
    run = """async () => {
      const { readSchema } = await import("/core/parameters.js");
      const { linkOf, readQuery, writeQuery } = await import("/features/page/url.js");
      const common = { label: "", symbol: "", step: 0.01, group: "" };
      const schema = readSchema({
        parameters: [
          { ...common, key: "activation.ta", default: 0.4 },
          { ...common, key: "vowel", default: "a", options: ["a", "i"] },
          { ...common, key: "x", default: 1 },
          { ...common, key: "posture.strain", optional_part: "posture" },
          { ...common, key: "run.error_estimate", type: "boolean" },
        ],
        sides: [],
        lists: [],
      });
      const query = writeQuery(schema, { vowel: "i", "run.error_estimate": true, "activation.ta": 0.55, x: 1 });
      const link = linkOf(schema, {}, "maps");
      const odd = readQuery(schema, "tongue=1&posture.strain=&x=&activation.ta=much");
      return [query, readQuery(schema, query), odd, link];
    }"""
    query, answer, odd, link = modules(run)
    assert query == "activation.ta=0.55&vowel=i&x=1&run.error_estimate=true"
    assert answer["patch"] == {"activation.ta": 0.55, "vowel": "i", "x": 1, "run.error_estimate": True}
    assert answer["unknown"] == [] and odd["unknown"] == ["tongue"]
    assert odd["patch"] == {"x": None, "activation.ta": "much"}, "the server refuses these by name"
    assert link.endswith("?paper=maps"), "a link copied in a section opens that section"
