// What is said below the diagram: the lift, where a derivative jumps, what stands still and why, and the checks that the motion decides.

import { figure } from "./numbers.js";
import { element } from "./player.js";

/** The lines in `host`. */
export function createMotionStatus(host, {store, t}) {
  const status = element("p", {class: "mf-status", role: "status", "data-testid": "programme-continuity"}), notes = element("p", {class: "mf-status mf-notes", "data-testid": "programme-notes", hidden: ""});
  const checks = element("p", {class: "mf-status mf-checks", "data-testid": "programme-checks", hidden: ""});
  host.append(status, notes, checks);

  /** Factor and title with the peak of every row. */
  function words({lift, speed}, peaks) {
    const names = speed ? [t("Velocity"), t("Acceleration"), t("Jerk")] : [t("First derivative"), t("Second derivative"), t("Third derivative")];
    const base = lift.angular ? "rad" : speed ? "m" : lift.unit, per = speed ? "s" : "rad", factors = [lift.factor, ...[1, 2, 3].map(order => speed ? speed ** order : lift.angular ? 1 : lift.factor)];
    const units = [lift.unit, ...["", "²", "³"].map(power => `${base}/${per}${power}`)], gap = unit => unit.startsWith("°") ? unit : `\u00a0${unit}`;
    const shownPeak = n => Number.isFinite(peaks[n]) ? `${figure(peaks[n] * factors[n])}${gap(units[n])}` : "∞";
    return {factors, titles: [[t("Lift"), shownPeak(0)], ...names.map((name, n) => [`${name} [${units[n + 1]}]`, t("peak *", shownPeak(n + 1))])]};
  }
  function tell(shown, jumps, titles) {
    const {cycle, origin} = shown, turned = angle => angle + (origin ?? 0) - (origin == null ? 0 : Math.floor((angle + origin) / cycle.span + 1e-9) * cycle.span);
    const at = order => jumps.filter(jump => jump.order === order).map(jump => `${figure(turned(jump.at) * cycle.factor, 4)}${cycle.unit}`).join(", ");
    const lines = [["mf-bad", at(1) && t("velocity jumps at *", at(1))], ["mf-warn", at(2) && t("acceleration jumps at *", at(2))]].filter(([, text]) => text);
    const smooth = lines.length ? [] : [element("span", {class: "mf-good"}, t("velocity and acceleration are continuous"))];
    status.replaceChildren(element("b", {}, `${titles[0][0]} ${titles[0][1]}`), ...smooth, ...lines.map(([look, text]) => element("span", {class: look}, text)));
    notes.hidden = !shown.notes?.length;
    notes.replaceChildren(...(shown.notes || []).map(text => element("span", {}, t(text))));
    check(shown);
  }
  /** Those checks that the result has, failing ones first. */
  function check({checks: names = []}) {
    const found = (store.state.result?.checks || []).filter(({name}) => names.some(own => name === own || name.endsWith(`.${own}`))).sort((a, b) => a.ok - b.ok);
    checks.hidden = !found.length;
    checks.replaceChildren(...found.map(({label, value, limit, ok, stale}) =>
      element("span", {class: `${ok ? "mf-good" : "mf-bad"}${stale ? " is-stale" : ""}`, title: stale ? t("not up to date") : ok ? t("passes") : t("fails")}, `${ok ? "✓" : "✕"} ${t(label)} ${value} (${limit})`)));
  }
  return {words, tell, check};
}
