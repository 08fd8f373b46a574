// SPDX-License-Identifier: MIT
/// @file
/// flat_lines: the three ways in which flat_storage keeps an id.
#pragma once

#include <tsubu/version.hpp>

namespace tsubu {

/// How flat_storage stores the ids it was given.
enum class flat_lines {
    narrow,  ///< 4-byte slots, 8 bytes per id: ranges up to about 2^26 at 1e6 ids
    wide,    ///< 8-byte slots, 16 bytes per id: ranges up to about 2^59
    keyed,   ///< 8-byte keys and 4-byte indices, 20 bytes per id: anything beyond
};

/// For messages: "narrow", and so on.
[[nodiscard]] constexpr const char* name_of(flat_lines lines) noexcept {
    switch (lines) {
        case flat_lines::narrow: return "narrow";
        case flat_lines::wide: return "wide";
        case flat_lines::keyed: break;
    }
    return "keyed";
}

}  // namespace tsubu
