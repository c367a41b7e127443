"""The page holds a patch: whatever way it takes, it is the same computation, and what is shown is in force."""

import random
import re
from functools import cache
from typing import Any

import pytest

from tests.browser.conftest import DESKTOP, PHONE
from vfcore.spec.address import address
from vfcore.spec.declarations import LARYNX
from vfcore.spec.paths import DECLARATIONS, LISTS, NUMBERS_BEYOND, known_declaration
from vfcore.spec.posture_sets import POSTURE_SETS
from vfcore.spec.request import resolve, values_of
from vfcore.spec.variants import VARIANTS

C_COUP = "constants.C_coup_pa_s_m"
LIVE_S = 0.5
#: The page sets the duration itself; a rise longer than it is refused.
NOT_DRAWN = {"model.variant", "model.posture_set", "run.duration_s", "run.pressure_rise_s"}
#: Sets patches in the page's own modules and returns all the ways that lead on from each.
WAYS = """async (cases) => {
  const params = await import("/core/parameters.js");
  const { getJson } = await import("/core/api.js");
  const request = await import("/state/request.js");
  const { firstDefaults, followDefaults } = await import("/features/live/follow-defaults.js");
  const { setConnection } = await import("/state/session.js");
  const { takeResult } = await import("/state/answers.js");
  const { readQuery, writeQuery } = await import("/features/page/url.js");
  const { hold, held } = await import("/features/compare/state.js");
  const { loadCell } = await import("/features/map/run.js");
  const schema = params.readSchema(await getJson("parameters"));
  const known = async () => {
    while (request.awaitsDefaults.value) await new Promise((resolve) => setTimeout(resolve, 2));
  };
  const body = (patch) => params.simulationRequest(patch, { duration_s: 0.5 });
  request.begin(schema, [], {}, await firstDefaults(schema, {}));
  setConnection("ready");
  takeResult({});
  const stop = followDefaults();
  const found = [];
  for (const { variant, set, entries, resets, cell, patient } of cases) {
    request.restorePatch({});
    request.chooseVariant(variant);
    if (set !== null) request.setValue("model.posture_set", set);
    if (patient) await known();
    for (const [path, value] of entries) request.setValue(path, value);
    for (const path of resets) request.resetValue(path);
    const sent = body(request.patch.value);
    const link = writeQuery(schema, request.patch.value);
    const base = request.patch.value;
    hold("a");
    await known();
    const values = request.values.value;
    const axes = Object.keys(cell).map((path) => ({ paths: [path] }));
    loadCell({ table: { axes }, base }, Object.values(cell));
    const ofCell = body(request.patch.value);
    request.chooseVariant("text_literal");
    request.restorePatch(held.value.a.patch);
    const kept = body(request.patch.value);
    found.push({ sent, read: body(readQuery(schema, link).patch), ofCell, kept, values });
  }
  stop();
  return found;
}"""
#: The server's schema with two more optional parts, before the page reads it.
NEW_PARTS = """
const read = Response.prototype.json;
Response.prototype.json = async function () {
  const document = await read.call(this);
  if (!document.parameters) return document;
  const strain = document.parameters.find((row) => row.key === "posture.strain");
  for (const [part, name, more] of [
    ["lesion", "height_mm", { type: "number" }],
    ["lesion", "kind", { type: "choice", options: ["nodule", "polyp"] }],
    ["patient", "is_asleep", { type: "boolean" }],
  ])
    document.parameters.push(
      { ...strain, key: `${part}.${name}`, label: name, group: part, optional_part: part, ...more },
    );
  return document;
};
"""
ANSWERED = """async () => {
  const [{ answered }, { version }] = await Promise.all([import("/state/answers.js"), import("/state/request.js")]);
  return answered.value === version.value;
}"""
#: What the page sends to the worker of a played voice.
SENT = """
window.sent = [];
const post = Worker.prototype.postMessage;
Worker.prototype.postMessage = function (message, ...rest) {
  if (message.open) window.sent.push(message.open.first);
  else if (message.send) window.sent.push(message.send);
  return post.call(this, message, ...rest);
};
"""


@cache
def in_force(variant: str, posture_set: str | None) -> dict[str, Any]:
    return values_of(resolve({"model.variant": variant, "model.posture_set": posture_set}))


def drawn(rng: random.Random, path: str) -> Any:
    """A value of its range; of a constant mostly that of some variant and set."""
    row = known_declaration(path)
    depends = row.name.endswith(("epsilon_1", "epsilon_2", "x_CAJ_m", "process_x_m"))  # on another one of the same set
    if row.part.endswith(LARYNX) and (depends or rng.random() < 0.8):
        return in_force(rng.choice(list(VARIANTS)), rng.choice(list(POSTURE_SETS)))[f"{LARYNX}.{row.name}"]
    if row.metadata["type"] == "boolean":
        return rng.random() < 0.5
    if row.metadata["type"] == "choice":
        return rng.choice(row.metadata["options"])
    if row.default is not None and rng.random() < 0.3:
        return row.default
    value = rng.uniform(row.metadata["low"], row.metadata["high"])
    return round(value) if row.is_whole else value


def cases_of(rng: random.Random, each: int) -> list[dict[str, Any]]:
    """For every variant and posture set: entries, some of which are reset, and the numbers of a cell."""
    paths = sorted(DECLARATIONS.keys() - NOT_DRAWN)
    sides = [path for path in NUMBERS_BEYOND if path.startswith(("left.", "right."))]
    lesion = [f"lesions.0.{name}" for name in LISTS["lesions"].rows]
    changed = sorted({f"{LARYNX}.{name}" for variant in VARIANTS.values() for name in variant.overrides})
    cases = []
    for variant in VARIANTS:
        for posture_set in (None, *POSTURE_SETS):
            for _ in range(each):
                chosen = rng.sample(paths, 6) + rng.sample(changed, 4) + rng.sample(sides, 3) + rng.sample(lesion, 2)
                up, right = rng.sample(changed, 1) + ["activation.ct"]
                cases.append(
                    {
                        "variant": variant, "set": posture_set, "patient": rng.random() < 0.5,
                        "entries": [(path, drawn(rng, path)) for path in chosen],
                        "resets": rng.sample(chosen, 2),
                        "cell": {up: drawn(rng, up), right: drawn(rng, right)},
                    }
                )  # fmt: skip
    return cases


def meant(case: dict[str, Any]) -> dict[str, Any]:
    """The patch that a case asks for, with nothing left out because it is in force anyway."""
    patch = {"model.variant": case["variant"], "run.duration_s": LIVE_S} | dict(case["entries"])
    if case["set"] is not None:
        patch["model.posture_set"] = case["set"]
    return {path: value for path, value in patch.items() if path not in case["resets"]}


def test_every_way_leads_to_the_same_computation(modules):
    cases = cases_of(random.Random(7), each=6)
    for case, found in zip(cases, modules(WAYS, cases), strict=True):
        patch = meant(case)
        wanted = resolve(patch)
        for way in ("sent", "read", "kept"):
            assert address(resolve(found[way])) == address(wanted), (way, case)
        cell = resolve(patch | case["cell"])
        assert address(resolve(found["ofCell"])) == address(cell), case
        in_force = values_of(wanted)
        missing = sorted(DECLARATIONS.keys() - {"run.duration_s"} - found["values"].keys())
        assert missing == [], (len(missing), missing[:5], case)
        for path in DECLARATIONS.keys() - {"run.duration_s"}:
            value, shown = in_force.get(path), found["values"][path]  # None: of a part that is not given
            # JavaScript writes large numbers as whole ones
            assert (float(shown) if isinstance(value, float) else shown) == value, (path, case)


def choose(here, variant: str) -> None:
    here.page.locator(".variant select").select_option(variant)
    here.settle()


def computed(here) -> dict[str, Any]:
    """The request of the result that is shown."""
    shown = here.page.evaluate("async () => (await import('/state/answers.js')).result.value.id")
    return here.api(f"jobs/{shown}/result")["provenance"]["request"]


@pytest.mark.parametrize("viewport", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_a_variant_shows_and_uses_its_own_coupling(visit, viewport):
    here = visit(viewport=viewport)
    phone = viewport is PHONE
    show = lambda tab: phone and here.page.locator(f"#tab-{tab}").click()  # noqa: E731
    show("more")
    choose(here, "human")
    assert computed(here)["model"]["coupling"] == "two_way"
    here.page.wait_for_url("**/?model.variant=human")
    show("muscles")
    here.page.locator(".advanced summary").click()
    coupling = here.page.locator("#control-model-coupling")
    assert coupling.input_value() == "two_way"
    coupling.select_option("one_way")
    here.settle()
    assert coupling.input_value() == "one_way" and computed(here)["model"]["coupling"] == "one_way"
    coupling.select_option(label="the variant’s own")
    here.settle()
    assert coupling.input_value() == "two_way" and computed(here)["model"]["coupling"] == "two_way"
    coupling.select_option("one_way")
    show("more")
    choose(here, "human_female")
    assert computed(here)["model"]["coupling"] == "two_way", "a variant brings its own again"
    choose(here, "paper")
    assert computed(here)["model"]["coupling"] == "one_way"


def test_a_constant_of_a_variant_is_shown_and_one_equal_to_the_papers_is_sent(visit):
    here = visit("?map")
    choose(here, "human")
    axis = here.page.get_by_role("combobox", name="Up: parameter")
    axis.select_option(C_COUP)
    ends = [here.page.get_by_role("textbox", name=f"Up: {end}").input_value() for end in ("from", "to")]
    assert [float(end) for end in ends] == [0.5 * 36, 1.5 * 36], "around the value in force"
    for field, text in (("Up: from", "10"), ("Up: to", "36"), ("Up: steps", "2"), ("To the right: steps", "2")):
        place = here.page.get_by_role("textbox", name=field)
        place.fill(text)
        place.press("Tab")
    here.page.get_by_role("button", name="Make the map").click()
    here.page.locator(".map-files").wait_for()
    here.page.locator(".map-run progress").wait_for(state="detached")
    cell = here.page.get_by_role("group", name="Choose a cell")
    cell.locator("select").first.select_option(label="10")
    cell.get_by_role("button", name="Load this voice").click()
    here.page.wait_for_url(lambda address: f"{C_COUP}=10" in address)
    here.settle()
    assert computed(here)["constants"]["C_coup_pa_s_m"] == 10
    cell.locator("select").first.select_option(label="36")
    cell.get_by_role("button", name="Load this voice").click()
    here.page.wait_for_url(lambda address: C_COUP not in address)
    here.settle()
    assert computed(here)["constants"] == {}, "36 is the variant's own"

    linked = visit(f"?model.variant=human&{C_COUP}=10")
    assert computed(linked)["constants"]["C_coup_pa_s_m"] == 10
    linked.page.get_by_role("button", name="Export").first.click()
    linked.page.get_by_role("button", name="Report to print").click()
    assert re.search(r"coupling damping.*\n10", linked.page.locator("article.report").inner_text(), re.I)


def test_the_tract_that_is_drawn_is_the_one_that_is_heard(visit):
    here = visit()
    choose(here, "human_female")
    here.page.locator("#panel-voice").click()
    here.painted()
    shown = here.page.evaluate("async () => (await import('/features/spectrum/tract.js')).tract.value.formants")
    wanted = here.api("tract/a?variant=human_female")["formants"]
    assert shown == wanted
    assert shown[0]["frequency_hz"] == pytest.approx(802, abs=1)
    assert shown[0] != here.api("tract/a")["formants"][0]
    scaled = visit("?constants.airway_scale=0.9&constants.c_a_m_s=340")
    shown = scaled.page.evaluate("async () => (await import('/features/spectrum/tract.js')).tract.value.formants")
    assert shown == here.api("tract/a?airway_scale=0.9&c_a_m_s=340")["formants"]


def test_defaults_are_asked_once_for_each_model_and_never_by_a_slider(visit):
    here = visit()
    asked = []
    here.page.on("request", lambda request: asked.append(request.post_data) if "/resolve" in request.url else None)
    for value in (0.1, 0.9, 0.5):
        here.set("activation.ct", value)
    here.page.locator(".preset select").select_option("breathy")
    here.settle()
    assert asked == []
    for variant in ("human", "paper", "human"):
        choose(here, variant)
    assert asked == ['{"model":{"variant":"human"}}']


def test_one_value_of_an_optional_part_shows_all_values_that_come_with_it(visit):
    here = visit()
    asked = []
    here.page.on("request", lambda request: asked.append(request.post_data) if "/resolve" in request.url else None)
    here.page.locator(".advanced summary").click()
    fields = [here.slider(f"posture.{name}") for name in ("strain", "glottal_half_angle_rad", "rest_angle_rad")]

    def type_in(place: int, text: str) -> list[str]:
        fields[place].fill(text)
        fields[place].press("Tab")
        here.settle()
        return [field.input_value() for field in fields]

    assert type_in(0, "0.1") == ["0.100", "0.000", "0.254"]
    posture = computed(here)["posture"]
    assert posture == {"strain": 0.1, "glottal_half_angle_rad": 0, "rest_angle_rad": 0.254}
    assert type_in(0, "0") == ["0.000", "0.000", "0.254"]
    assert computed(here)["posture"] == posture | {"strain": 0}, "the part stays given"
    assert here.page.get_by_label("Voice").locator("option:checked").inner_text() == "Own settings"
    assert type_in(1, "") == ["0.000", "0.000", "0.254"], "an emptied field shows what is in force"
    assert type_in(2, "0.3") == ["0.000", "0.000", "0.300"]
    assert type_in(2, "") == ["0.000", "0.000", "0.254"]
    assert type_in(0, "") == ["", "", ""]
    assert computed(here)["posture"] is None
    assert asked == ['{"posture":{}}'], "once, when the part comes; never for a value in it"
    linked = visit("?posture.rest_angle_rad=0.3")
    linked.page.locator(".advanced summary").click()
    assert linked.slider("posture.glottal_half_angle_rad").input_value() == "0.000"


def test_a_new_optional_part_gets_controls_and_is_taken_back_by_a_preset(visit):
    here = visit(init=NEW_PARTS)
    here.expected = re.compile("422")  # the server does not know the parts
    here.page.locator(".advanced summary").click()
    height, kind = here.slider("lesion.height_mm"), here.slider("lesion.kind")
    assert height.get_attribute("placeholder") == "not given"
    assert here.slider("posture.strain").get_attribute("placeholder") == "by the muscles"
    assert kind.locator("option").all_inner_texts() == ["not given", "nodule", "polyp"]
    assert here.slider("patient.is_asleep").locator("option").all_inner_texts() == ["not given", "yes", "no"]
    patch = "async () => (await import('/state/request.js')).patch.value"
    height.fill("1")
    height.press("Tab")
    kind.select_option("polyp")
    here.slider("patient.is_asleep").select_option("no")
    wanted = {"lesion.height_mm": 1, "lesion.kind": "polyp", "patient.is_asleep": False}
    assert here.page.evaluate(patch) == wanted
    kind.select_option("not given")
    assert here.page.evaluate(patch) == {key: wanted[key] for key in wanted if key != "lesion.kind"}
    here.page.get_by_label("Voice").select_option("breathy")
    assert here.page.evaluate(patch) == {"activation.pca": 0.5}
    here.settle()


def test_old_values_stay_until_the_new_ones_are_there_and_a_failed_call_is_repeated(visit):
    here = visit()
    here.expected = re.compile("Failed to load resource")
    here.page.route("**/api/v1/resolve", lambda route: route.abort())
    here.page.locator(".advanced summary").click()
    boxes = "() => [...document.querySelectorAll('.left *')].map((e) => [e.offsetTop, e.offsetHeight])"
    before = here.page.evaluate(boxes)
    here.page.locator(".variant select").select_option("human")
    here.page.wait_for_function(ANSWERED)  # a live answer is a reason of its own to call again
    here.page.wait_for_timeout(500)
    value = f"async () => (await import('/state/request.js')).values.value['{C_COUP}']"
    assert here.page.evaluate(value) == 10
    assert here.page.locator("#control-model-coupling").input_value() == "one_way"
    assert here.page.evaluate(boxes) == before
    here.page.unroute("**/api/v1/resolve")
    here.settle()
    assert here.page.evaluate(value) == 36
    assert here.page.locator("#control-model-coupling").input_value() == "two_way"
    assert here.page.evaluate(boxes) == before, "nothing moves"


def test_a_refused_model_is_named_and_the_page_goes_on(visit):
    here = visit("?model.variant=giraffe&activation.ct=0.5", wait=False)
    here.expected = re.compile("422")
    here.settle()
    assert here.typed("Cricothyroid (CT)").input_value() == "0.50"
    assert here.typed("Thyroarytenoid (TA)").input_value() == "0.40"
    choose(here, "human")
    assert computed(here)["model"]["variant"] == "human"


def test_a_played_voice_gets_the_patch_and_then_what_changes(visit):
    here = visit("?activation.ct=0.6&model.variant=human", init=SENT)
    here.page.get_by_role("tab", name="Play", exact=True).click()
    here.page.get_by_role("button", name="Play live").click()
    sounding = "async () => (await import('/state/played-voice.js')).status.value === 'on'"
    here.page.wait_for_function(sounding)
    slider = here.slider("activation.ct")
    slider.locator("..").dblclick(position={"x": 3, "y": 3})
    here.page.wait_for_url("**/?model.variant=human")
    sent = here.page.evaluate("sent")
    assert sent[0] == {"activation": {"ct": 0.6}, "model": {"variant": "human"}}
    assert sent[-1]["activation"] == {"ct": 0.3}, "a reset sends the value in force"
    here.page.locator(".variant select").select_option("paper")
    here.page.wait_for_function("() => sent.some((one) => Object.keys(one).length === 0)")
    here.page.wait_for_function(sounding)
    here.page.get_by_role("button", name="Stop").first.click()


def test_a_preset_takes_back_breath_and_convergence_and_keeps_vowel_model_and_constants(visit):
    kept = "vowel=i&model.variant=human&constants.K_col_pa_m=2000000"
    here = visit(f"?subglottal_pressure_pa=700&convergence_angle_rad=0.1&posture.strain=0.1&{kept}")
    here.page.locator(".preset select").select_option("breathy")
    here.settle()
    patch = here.page.evaluate("async () => (await import('/state/request.js')).patch.value")
    assert {path: value for path, value in patch.items() if not path.startswith("activation.")} == {
        "vowel": "i",
        "model.variant": "human",
        "constants.K_col_pa_m": 2e6,
    }
    assert patch["activation.pca"] == 0.5
