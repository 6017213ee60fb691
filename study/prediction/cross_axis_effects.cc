// What the other axes of the machine do to this one; each of the log's other axes by itself.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "study/prediction/effect_steps.h"
#include "study/prediction/other_axes.h"

namespace towbench::study::diagnose {
namespace {

// Kinetic and potential energy of rigid links, one behind the other.
constexpr const char* kLinks = "Siciliano et al. 2009, ch. 7";

template <int other>
std::vector<Scales> where_it_moves(const Context& c) {
  const bool there = c.others.size() > other && c.others[other].moves;
  return there ? std::vector<Scales>{{}} : std::vector<Scales>{};
}
template <int other>
std::vector<Scales> between_joints(const Context& c) {
  return c.stated.rotary && c.others.size() > other && c.others[other].rotary
             ? where_it_moves<other>(c)
             : std::vector<Scales>{};
}

double inertia_step(const Context& c) {
  return 0.02 * c.stated.mass_kg;
}

template <int other>
class OfOne {
 public:
  explicit OfOne(std::vector<Effect>& library) : library_(library) {}

  void add_all() {
    add({.name = "cross_axis_coupling",
         .cause = "forces from the motion of another axis",
         .law = "m w' + b w, w the other's speed",
         .source = "MACS-A-6",
         .amplitudes = {key(OtherKey::kMass), key(OtherKey::kViscous)},
         .amplitude_names = {"mass_kg", "viscous_N_s_per_m"},
         .grid = where_it_moves<other>,
         .step = force_step});
    add({.name = "cross_axis_coupling",
         .cause = "inertia shared with another joint, that depends on its place",
         .law = "d/dt((m + c cos q + s sin q) w), q and w of the other",
         .source = kLinks,
         .amplitudes = {key(OtherKey::kMass), key(OtherKey::kCosine), key(OtherKey::kSine)},
         .amplitude_names = {"mass_kg", "cosine_kg", "sine_kg"},
         .grid = between_joints<other>,
         .step = inertia_step});
    add({.name = "cross_axis_coupling",
         .cause = "inertia shared with another joint, that depends on this one's place",
         .law = "(m + c cos x + s sin x) w' + (c sin x - s cos x) w^2",
         .source = kLinks,
         .amplitudes = {key(OtherKey::kMass), key(OtherKey::kOwnCosine), key(OtherKey::kOwnSine)},
         .amplitude_names = {"mass_kg", "cosine_kg", "sine_kg"},
         .grid = between_joints<other>,
         .step = inertia_step});
    add({.name = "cross_axis_inertia",
         .cause = "an inertia that depends on the place of another joint",
         .law = "d/dt((c cos q + s sin q) v), q of the other",
         .source = kLinks,
         .amplitudes = {key(OtherKey::kInertiaCosine), key(OtherKey::kInertiaSine)},
         .amplitude_names = {"cosine_kg", "sine_kg"},
         .grid = between_joints<other>,
         .step = inertia_step});
    add({.name = "cross_axis_gravity",
         .cause = "a weight that hangs on this joint and another",
         .law = "s sin(x + q) + c cos(x + q), q of the other",
         .source = kLinks,
         .amplitudes = {key(OtherKey::kWeightSine), key(OtherKey::kWeightCosine)},
         .amplitude_names = {"sine_Nm", "cosine_Nm"},
         .structural = true,
         .grid = between_joints<other>,
         .step = force_step});
  }

 private:
  static constexpr Key key(OtherKey which) { return key_of(other, which); }

  void add(Effect effect) {
    effect.needs = "a log that has the other axis, moving on its own";
    effect.set = set_nothing;
    effect.other = other;
    if constexpr (other > 0) {
      const std::string number = std::to_string(other + 1);
      effect.name += "_" + number;
      effect.cause += " (no. " + number + " of the map)";
    }
    library_.push_back(std::move(effect));
  }

  std::vector<Effect>& library_;
};

}  // namespace

void add_cross_axis_effects(std::vector<Effect>& library) {
  [&]<int... other>(std::integer_sequence<int, other...>) {
    (OfOne<other>(library).add_all(), ...);
  }
  (std::make_integer_sequence<int, kOthers>{});
}

}  // namespace towbench::study::diagnose
