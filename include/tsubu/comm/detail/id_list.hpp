// SPDX-License-Identifier: MIT
/// @file
/// The ids of the owned particles of a rank, as functions of all ranks take them.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>      // std::size_t
#include <iterator>     // std::data, std::size
#include <span>         // std::span
#include <string>       // std::to_string
#include <type_traits>  // std::remove_cv_t, std::remove_pointer_t
#include <utility>      // std::declval

namespace tsubu::detail {

/// What lies in a row in an array, a vector, a span of either, ...
template <class List>
using element_of = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const List&>()))>>;
/// Ids in a row.
template <class List>
concept id_list = requires(const List& ids) {
    std::size(ids);
    requires particle_id<element_of<List>>;
};
template <id_list List>
[[nodiscard]] std::span<const element_of<List>> span_of(const List& ids) noexcept {
    return {std::data(ids), std::size(ids)};
}

/// @throws input_error with the first that is negative.
template <particle_id Id>
void check_ids(const char* where, std::span<const Id> ids) {
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (is_negative(ids[i]))
            raise<input_error>(where, "the id at index " + std::to_string(i) + " is " + std::to_string(ids[i]),
                               "ids of particles are 0 or greater");
}

}  // namespace tsubu::detail
