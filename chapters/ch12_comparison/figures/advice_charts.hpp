/// @file
/// The charts of how good the advice is.
#pragma once

#include "chapters/ch12_comparison/measured/advice_data.hpp"
#include "common/program/chart.hpp"

namespace space::ch12 {

/// All questions, sorted by what the advice costs over the best in hindsight.
Chart advice_chart(const JudgedAdvice& judged);
/// The same, question by question, on scenes that it was not fitted on.
Chart advice_misses_chart(const JudgedAdvice& judged);

}  // namespace space::ch12
