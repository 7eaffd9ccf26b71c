/// @file
/// What the lab counts on one of the book's scenes, for the chapter's page.
#pragma once

#include "common/program/numbers.hpp"

namespace space::ch12 {

/// Each structure of the book, with its default triangle test, on the scene and the picture that
/// the page's example names.
void count_lab(Numbers& numbers);

}  // namespace space::ch12
