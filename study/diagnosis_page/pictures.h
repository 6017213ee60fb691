// What a diagnosis looks like: force measured against modelled, what is left against everything it
// might depend on, and what each cause takes away.
#pragma once

#include <vector>

#include "study/diagnose/diagnosis.h"
#include "study/procedures/figure.h"

namespace towbench::study::diagnosis_page {

// In the order of the page. `d` has no fatal finding.
[[nodiscard]] std::vector<procedures::Figure> pictures(const diagnose::Diagnosis& d);

}  // namespace towbench::study::diagnosis_page
