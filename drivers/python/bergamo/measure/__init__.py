"""What people compute next from grains and contacts: the program's own measures (dem/measure/), and some more."""

from .chains import ForceChains, force_chains
from .coordination import Coordination, coordination_numbers, is_rattler
from .fabric import anisotropy, fabric_tensor
from .profiles import Profile, profile, stress_profile
from .solid import Box, Sphere, sampled_solid_fraction, solid_fraction, solid_fraction_in
from .stresses import deviatoric_stress, force_moment, pressure, principal_stresses, stress, stress_in_box

__all__ = [
    "Box", "Coordination", "ForceChains", "Profile", "Sphere", "anisotropy", "coordination_numbers", "deviatoric_stress",
    "fabric_tensor", "force_chains", "force_moment", "is_rattler", "pressure", "principal_stresses", "profile",
    "sampled_solid_fraction", "solid_fraction", "solid_fraction_in", "stress", "stress_in_box", "stress_profile",
]
