// Which of the accepted causes is not worth a name beside the others, or beside what is left.
#pragma once

#include <optional>
#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

// Two free shapes at once fit almost anything: the one that says less. And what is weak beside
// another.
[[nodiscard]] std::optional<std::size_t> weak_beside_others(const std::vector<Cause>& causes);

// Where much is left that no effect explains, free shapes and clips take on what is not theirs:
// there they must say a good part of it. `gain`: of all causes together.
[[nodiscard]] std::optional<std::size_t> weak_beside_the_rest(const std::vector<Cause>& causes,
                                                              double gain);

// True where a cause is likely the misfit of the strongest one's law: it takes few squares beside
// that one, and few of what the others leave.
[[nodiscard]] bool is_weak_beside(double taken, double by_the_strongest, double share_of_left);

}  // namespace towbench::study::diagnose
