// SPDX-License-Identifier: MIT
/// @file
/// Asking for a line of memory ahead of its use.
#pragma once

namespace tsubu::detail {

/// Asks for the cache line of an address, to be written if Write. Any address may be asked for.
///
/// A function that does nothing but __builtin_prefetch has no effect in the eyes of GCC, which then drops the calls
/// that it has not inlined yet; an empty instruction that nobody may drop keeps them.
template <bool Write = false>
inline void prefetch(const void* address) noexcept {
    __builtin_prefetch(address, Write);
    asm volatile("" : : "r"(address));
}

}  // namespace tsubu::detail
