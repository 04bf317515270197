// The tables behind schema.h, in three parts (internal to this folder).
#pragma once

#include <span>

#include "coupling/scene/schema.h"

namespace interstice::scene {

std::span<const Section> material_sections();
std::span<const Section> particle_sections();
std::span<const Section> course_sections();

constexpr Range positive(std::string_view reason) { return {.lo = 0, .lo_open = true, .reason = reason}; }
constexpr Range not_negative(std::string_view reason) { return {.lo = 0, .reason = reason}; }

}  // namespace interstice::scene
