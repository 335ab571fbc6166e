#include "fe_dealii/mesh/material_box.h"

#include "dem/core/error.h"

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

namespace bergamo::fe
{

void MaterialBox::validate() const
{
  for (int i = 0; i < 3; ++i)
    if (!(maximum[i] > minimum[i]))
      reject("material box: along ", "xyz"[i], " it reaches from ", minimum[i], " to ", maximum[i],
             " m; the maximum must exceed the minimum");
  if (material_id == dealii::numbers::invalid_material_id)
    reject("material box: ", material_id, " is no material id, which end at ", material_id - 1);
}

void set_material(const MaterialBox &box, dealii::Triangulation<3, 3> &triangulation)
{
  box.validate();
  bool is_empty = true;
  for (const auto &cell : triangulation.active_cell_iterators())
  {
    const dealii::Point<3> centre = cell->center();
    bool is_inside = true;
    for (int i = 0; i < 3; ++i)
      is_inside = is_inside && centre[i] >= box.minimum[i] && centre[i] <= box.maximum[i];
    if (!is_inside)
      continue;
    cell->set_material_id(box.material_id);
    is_empty = false;
  }
  if (is_empty)
    reject("material box: that of the material id ", box.material_id, ", from (", box.minimum[0], ", ", box.minimum[1],
           ", ", box.minimum[2], ") to (", box.maximum[0], ", ", box.maximum[1], ", ", box.maximum[2],
           ") m, has no cell's centre in it; move or enlarge it, or choose a finer mesh");
}

} // namespace bergamo::fe
