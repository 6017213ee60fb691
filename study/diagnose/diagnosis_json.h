// diagnosis.json, schema towbench/diagnosis/1, and the series behind its pictures.
#pragma once

#include <filesystem>
#include <string>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// Gains in per cent, parameters with their unit in the name.
[[nodiscard]] std::string diagnosis_json(const Diagnosis& diagnosis);

// residual.csv: one row a judged sample (time, position, speed, acceleration, input, force residual
// before and after, and what each cause takes away). unexplained.csv: the shape that is left.
void write_series(const Diagnosis& diagnosis, const std::filesystem::path& folder);

}  // namespace towbench::study::diagnose
