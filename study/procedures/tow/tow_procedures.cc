#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study::procedures {

std::vector<std::unique_ptr<TowProcedure>> tow_procedures() {
  std::vector<std::unique_ptr<TowProcedure>> all;
  for (const auto make : {straight_drag, curved_drag, drag_at_yaw, manoeuvres, fin_thrust,
                          subtraction, added_mass, loaded_tracking}) {
    all.push_back(make());
  }
  return all;
}

}  // namespace towbench::study::procedures
