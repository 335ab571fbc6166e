#include "dem/force/contact_set_copies.h"
#include "dem/force/contact_set_renewal.h"
#include "dem/force/contact_set_step.h"
#include "dem/force/kinds/grain_grain.h"
#include "dem/force/kinds/grain_plane.h"
#include "dem/force/kinds/grain_surface.h"
#include "dem/force/kinds/sphere_sphere.h"

namespace bergamo::dem
{

template class ContactSet<GrainGrain>;
template class ContactSet<SphereSphere>;
template class ContactSet<GrainPlane>;
template class ContactSet<GrainSurface>;

} // namespace bergamo::dem
