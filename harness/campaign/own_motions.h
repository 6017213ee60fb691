// A campaign on another machine than its base's: `[instead]` names the machine's own motion in the
// place of a motion of the base,
//
//   [instead]
//   any-trapezoid-y = "experiment.toml"
//
// Motions of the base without one are left out, with the faults that are tried on no other and
// those of an axis that no motion's machine has. `[sizes]` states a fault's parameters where the
// base takes the catalogue's standard, which is the tow tank's:
//
//   [sizes]
//   "supply.sag" = "lost_V=15"
#pragma once

#include "harness/campaign/campaign.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

// Nothing to do without the tables. `reader` is at the file's root. Throws FixtureError.
void take_own_motions(TableReader& reader, Campaign& campaign);

}  // namespace towbench::harness
