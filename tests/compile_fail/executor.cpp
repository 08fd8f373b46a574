// SPDX-License-Identifier: MIT
#include <tsubu/core/executor.hpp>

#include <cstddef>

namespace {

struct pool {
#if !defined(CASE)
    static std::size_t concurrency() noexcept { return 1; }
#endif
    template <class Part>
    static void run(Part&& part) {
        part(std::size_t{0});
    }
};

}  // namespace

bool built() {
    bool done = false;
    const auto on = [&](const tsubu::executor auto& team) { team.run([&](std::size_t) { done = true; }); };
    on(pool{});
    return done;
}
