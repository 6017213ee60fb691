#include "study/prediction/weak_causes.h"

#include <algorithm>

namespace towbench::study::diagnose {
namespace {

// Of the squares that the strongest takes: in force, 5 % and a fifth of it.
constexpr double kLeastBesideStrong = 0.0025;
constexpr double kEnoughBesideStrong = 0.04;
constexpr double kMostOfLeft = 0.75;  // at which a cause is no misfit of another: half of the rms
constexpr double kMuch = 0.25;        // least gain of all, and of a free shape or a clip
constexpr double kPlainGain = 0.03;   // of any other, two standard errors below it

bool is_free(const Cause& cause) {
  return cause.effect->flexible || cause.sought;
}

template <typename Less, typename Among>
std::optional<std::size_t> least(const std::vector<Cause>& causes, Less less, Among among) {
  std::optional<std::size_t> out;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    if (among(causes[i]) && (!out || less(causes[i], causes[*out]))) out = i;
  }
  return out;
}

bool gains_less(const Cause& one, const Cause& other) {
  return one.gain.gain < other.gain.gain;
}

}  // namespace

std::optional<std::size_t> weak_beside_others(const std::vector<Cause>& causes) {
  if (std::count_if(causes.begin(), causes.end(), is_free) > 1) {
    return least(causes, gains_less, is_free);
  }
  double most = 0;
  for (const Cause& cause : causes) most = std::max(most, cause.power);
  return least(
      causes, [](const Cause& a, const Cause& b) { return a.power < b.power; },
      [&](const Cause& cause) { return is_weak_beside(cause.power, most, cause.share); });
}

bool is_weak_beside(double taken, double by_the_strongest, double share_of_left) {
  const double of = taken / std::max(1e-300, by_the_strongest);
  return of < kLeastBesideStrong || (of < kEnoughBesideStrong && share_of_left < kMostOfLeft);
}

std::optional<std::size_t> weak_beside_the_rest(const std::vector<Cause>& causes, double gain) {
  const auto any = [](const Cause&) { return true; };
  if (gain < kMuch) return least(causes, gains_less, any);
  // Free shapes first: beside them what is real looks weak.
  const auto shape = [](const Cause& cause) {
    return (is_free(cause) || cause.effect->whole != 0) && cause.gain.gain < kMuch;
  };
  if (const auto found = least(causes, gains_less, shape)) return found;
  return least(causes, gains_less, [](const Cause& cause) {
    return !is_free(cause) && cause.effect->whole == 0 && cause.gain.low < kPlainGain;
  });
}

}  // namespace towbench::study::diagnose
