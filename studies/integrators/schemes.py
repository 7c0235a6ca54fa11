"""The schemes that are compared: their keys in `[integrator]`, the order and the limit of omega dt that they are known for."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

TABLES = {  # of Runge-Kutta, by kind: order
    "explicit": {"heun_euler_2_1_2": 2, "knoth_wolke_3_3": 3, "bogacki_shampine_4_2_3": 3, "zonneveld_5_3_4": 4,
                 "sayfy_aburub_6_3_4": 4, "cash_karp_6_4_5": 5, "fehlberg_6_4_5": 5, "dormand_prince_7_4_5": 5,
                 "verner_8_5_6": 6, "fehlberg_13_7_8": 8},
    "implicit": {"sdirk_2_1_2": 2, "billington_3_3_2": 2, "trbdf2_3_3_2": 2, "kvaerno_4_2_3": 3,
                 "esdirk324l2sa_4_2_3": 3, "esdirk325l2sa_5_2_3": 3, "esdirk32i5l2sa_5_2_3": 3, "cash_5_2_4": 4,
                 "cash_5_3_4": 4, "sdirk_5_3_4": 4, "kvaerno_5_3_4": 4, "esdirk436l2sa_6_3_4": 4,
                 "esdirk43i6l2sa_6_3_4": 4, "qesdirk436l2sa_6_3_4": 4, "esdirk437l2sa_7_3_4": 4, "kvaerno_7_4_5": 5,
                 "esdirk547l2sa_7_4_5": 5, "esdirk547l2sa2_7_4_5": 5},
    "additive": {"ark324l2sa_4_2_3": 3, "ark436l2sa_6_3_4": 4, "ark437l2sa_7_3_4": 4, "ark548l2sa_8_4_5": 5,
                 "ark548l2sab_8_4_5": 5},
}
MULTIRATE = {"mis_kw3": 3, "mri_gark_erk33a": 3, "mri_gark_erk45a": 4}
SHORT_STEPS = 1e-10     # rtol of the short steps: far below what the long ones do
COMPOSITIONS = {"single": 2, "yoshida_3": 4, "suzuki_5": 4, "mclachlan_5": 4}


@dataclass(frozen=True)
class Scheme:
    """One scheme. `setting` is the key that its accuracy is chosen with: dt of fixed steps, rtol of adaptive ones."""

    name: str
    family: str                 # those of one stand together in figures
    integrator: dict[str, Any]
    order: int | None           # None: it varies
    setting: str = "dt"
    explicit: bool = False
    title: str = ""             # in figures

    @property
    def label(self) -> str:
        return self.title or self.name.replace("_", " ")


def _fixed(name: str, family: str, order: int, explicit: bool = False, title: str = "", **keys: Any) -> Scheme:
    return Scheme(name, family, keys, order, "dt", explicit, title)


def _explicit() -> list[Scheme]:
    found = [_fixed("central_difference", "leapfrog", 2, True, type="central_difference"),
             _fixed("noh_bathe", "leapfrog", 2, True, "Noh-Bathe, p = 0.54", type="noh_bathe")]
    for composition, order in COMPOSITIONS.items():
        for form in ("velocity", "position"):
            found.append(_fixed(f"verlet_{composition}_{form}", "Verlet", order, True,
                                f"Verlet {composition.replace('_', ' ')}, {form}",
                                type="verlet", composition=composition, form=form))
    return found


def _implicit() -> list[Scheme]:
    return [
        _fixed("newmark", "Newmark", 2, title="Newmark, mean acceleration", type="newmark"),
        _fixed("newmark_linear", "Newmark", 2, title="Newmark, linear acceleration", type="newmark", beta=1 / 6),
        _fixed("newmark_damped", "Newmark", 1, title="Newmark, γ = 0.6", type="newmark", beta=0.3025, gamma=0.6),
        _fixed("generalized_alpha", "Newmark", 2, title="generalized-α, ρ∞ = 0.8", type="generalized_alpha"),
        _fixed("generalized_alpha_0", "Newmark", 2, title="generalized-α, ρ∞ = 0", type="generalized_alpha", rho_inf=0.0),
        _fixed("hht_alpha", "Newmark", 2, title="HHT-α, α = 0.1", type="hht_alpha"),
        _fixed("bathe", "Bathe", 2, title="Bathe, ρ∞ = 0.8", type="bathe"),
        _fixed("bathe_0", "Bathe", 2, title="Bathe, ρ∞ = 0", type="bathe", rho_inf=0.0),
    ]


def _runge_kutta() -> list[Scheme]:
    return [_fixed(table, f"{kind} Runge-Kutta", order, kind == "explicit", table, type="arkode", table=table)
            for kind, tables in TABLES.items() for table, order in tables.items()]


def _multirate() -> list[Scheme]:
    return [_fixed(table, "multirate", order, True, f"MRI, {table.removeprefix('mri_')}", type="mri", slow_table=table,
                   rtol=SHORT_STEPS) for table, order in MULTIRATE.items()]


def _to_a_tolerance() -> list[Scheme]:
    def adaptive(name: str, title: str, order: int | None = None, **keys: Any) -> Scheme:
        return Scheme(name, "to a tolerance", keys, order, "rtol", False, title)

    return [
        adaptive("cvode_adams", "CVODE Adams", type="cvode", method="adams"),
        adaptive("cvode_adams_functional", "CVODE Adams, fixed point", type="cvode", method="adams",
                 iteration="functional"),
        adaptive("cvode_bdf", "CVODE BDF", type="cvode", method="bdf"),
        adaptive("cvode_bdf_2", "CVODE BDF, order 2", 2, type="cvode", method="bdf", max_order=2),
        adaptive("cvode_adams_4", "CVODE Adams, order 4", 4, type="cvode", method="adams", max_order=4),
        adaptive("ida", "IDA", type="ida"),
        adaptive("ida_2", "IDA, order 2", 2, type="ida", max_order=2),
        adaptive("arkode_explicit", "ARKODE, Dormand-Prince", 5, type="arkode", table="dormand_prince_7_4_5"),
        adaptive("arkode_implicit", "ARKODE, ESDIRK5", 5, type="arkode", table="esdirk547l2sa_7_4_5"),
        adaptive("generalized_alpha_adaptive", "generalized-α, adaptive", 2, type="generalized_alpha", adaptive=True),
        adaptive("newmark_adaptive", "Newmark, adaptive", 2, type="newmark", adaptive=True),
        adaptive("hht_alpha_adaptive", "HHT-α, adaptive", 2, type="hht_alpha", adaptive=True),
    ]


SCHEMES = {scheme.name: scheme for scheme in _explicit() + _implicit() + _runge_kutta() + _multirate()
           + _to_a_tolerance()}


def fixed() -> list[Scheme]:
    return [scheme for scheme in SCHEMES.values() if scheme.setting == "dt"]


def applicable(scheme: Scheme, deck: dict[str, Any]) -> bool:
    """Whether the program takes the scheme on this deck: `mri` asks for contact or joints, its short steps."""
    return scheme.integrator["type"] != "mri" or "contact" in deck or "fracture" in deck


def representatives() -> list[Scheme]:
    """One or two of each kind, for figures and for the quick study."""
    return [SCHEMES[name] for name in (
        "central_difference", "noh_bathe", "verlet_mclachlan_5_velocity", "dormand_prince_7_4_5", "fehlberg_13_7_8", "newmark",
        "generalized_alpha", "bathe_0", "esdirk547l2sa_7_4_5", "cvode_adams", "cvode_bdf", "ida", "mri_gark_erk45a")]
