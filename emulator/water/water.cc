#include "emulator/water/water.h"

namespace towbench::emulator {
namespace {

PlaneVector operator+(PlaneVector a, const PlaneVector& b) noexcept {
  for (const core::Axis axis : core::kPlanarAxes) {
    a[axis] += b[axis];
  }
  return a;
}

}  // namespace

const char* inconsistency(const WaterParameters& water) noexcept {
  if (water.fin.fitted && !water.object.in_water) {
    return "water.fin.fitted needs water.object.in_water: a fin in the air pushes nothing";
  }
  return nullptr;
}

double added_mass_kg(const WaterParameters& water) noexcept {
  return (water.shaft.in_water ? water.shaft.added_mass_kg : 0.0) +
         (water.object.in_water ? water.object.added_mass_kg : 0.0);
}

Water::Water(const WaterParameters& p) noexcept
    : shaft_(p.shaft),
      object_(p.object),
      fin_(p.fin, p.object.yaw_deg),
      fin_works_(p.fin.fitted && p.object.in_water) {}

PlaneVector Water::force_N(core::Nanoseconds start_ns, const PlaneVector& velocity) const noexcept {
  const PlaneVector drag = shaft_(velocity) + object_(velocity);
  return fin_works_ ? drag + fin_.over_tick(start_ns) : drag;
}

}  // namespace towbench::emulator
