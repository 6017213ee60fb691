// A diagnosis as one page that needs nothing but a browser.
#pragma once

#include <string>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnosis_page {

// `title`: what was judged against what. With a fatal finding the page says why there is nothing.
[[nodiscard]] std::string page(const std::string& title, const diagnose::Diagnosis& d);

}  // namespace towbench::study::diagnosis_page
