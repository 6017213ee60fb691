#include "study/procedures/tow/tow_loads.h"

#include <utility>

namespace towbench::study::procedures {

TowLoads::TowLoads(harness::RigFixture machine, harness::ControllerFixture controller,
                   std::uint64_t seed, std::filesystem::path rigs, harness::LoopWatchers watchers,
                   RunSource* source)
    : machine_(std::move(machine)),
      controller_(std::move(controller)),
      seed_(seed),
      rigs_(std::move(rigs)),
      watchers_(std::move(watchers)),
      source_(source) {}

harness::RigFixture TowLoads::fixture(const Load& load) const {
  harness::SourceFiles sources;
  const auto named = harness::load_rig(rigs_ / (load.rig + ".toml"), sources).parameters;
  harness::RigFixture rig = machine_;
  rig.parameters.water = named.water;
  rig.parameters.force_sensor.load_mass_kg = named.force_sensor.load_mass_kg;
  rig.parameters.force_sensor.lever_m = named.force_sensor.lever_m;
  if (load.yaw_deg) {
    rig.parameters.water.object.yaw_deg = *load.yaw_deg;
  }
  rig.parameters.water.fin.fitted = rig.parameters.water.fin.fitted && load.fin_works;
  return rig;
}

Machine TowLoads::with(const Load& load) const {
  return {fixture(load), controller_, seed_, watchers_, source_};
}

bool TowLoads::in_water(const Load& load) const {
  return fixture(load).parameters.water.present();
}

emulator::RigParameters TowLoads::truth(const Load& load) const {
  return fixture(load).parameters;
}

}  // namespace towbench::study::procedures
