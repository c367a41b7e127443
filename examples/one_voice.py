"""One voice: raise the cricothyroid (CT) activation and read pitch, closed quotient and the flow waveform."""

import vfcore

for ct in (0.3, 0.8):
    result = vfcore.simulate(vfcore.Simulation(activation=vfcore.Activation(ct=ct)))
    measures = result.report.measures
    print(f"CT {ct}: {result.report.state}")
    for key in ("fo_hz", "closed_quotient", "mean_flow_ml_s"):
        measure = measures[key]  # a value, or None and the reason
        text = measure.reason if measure.value is None else f"{measure.value:.4g} {measure.unit}"
        print(f"  {key}: {text}")

flow = result.arrays["glottal_flow_m3_s"]
print(f"flow: {flow.size} samples at {result.provenance.sample_rate_hz:.0f} Hz, peak {flow.max() * 1e6:.0f} mL/s")
