// SPDX-License-Identifier: MIT
#include <tsubu/core/instruction_set.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

using tsubu::instruction_set;

namespace {

/// The variable as it is told, and afterwards as before; so is the set in use.
class asked_for {
public:
    explicit asked_for(const char* name) {
        if (const char* const old = std::getenv(variable)) old_ = old;
        ::setenv(variable, name, 1);
        tsubu::detail::instruction_set_in_use = tsubu::detail::instruction_set_unknown;  // as before the first call
    }
    asked_for(const asked_for&) = delete;
    ~asked_for() {
        if (old_.empty())
            ::unsetenv(variable);
        else
            ::setenv(variable, old_.c_str(), 1);
        tsubu::use_instruction_set(tsubu::supported_instruction_set());
    }

private:
    static constexpr auto variable = "TSUBU_INSTRUCTION_SET";
    std::string old_;
};

}  // namespace

TEST_CASE("the variable lowers the instruction set, and never raises it", "[core][instruction_set]") {
    const auto best = tsubu::supported_instruction_set();
    const auto found = [](const char* name) {
        const asked_for it(name);
        return tsubu::best_instruction_set();
    };
    CHECK(found("portable") == instruction_set::portable);
    CHECK(found("avx2") == std::min(best, instruction_set::avx2));
    CHECK(found("avx512") == best);
    CHECK(found("sse9") == best);
    CHECK(found("") == best);
}
TEST_CASE("an instruction set has the name by which it is asked for", "[core][instruction_set]") {
    CHECK(std::string(name_of(instruction_set::portable)) == "portable");
    CHECK(std::string(name_of(instruction_set::avx2)) == "avx2");
    CHECK(std::string(name_of(instruction_set::avx512)) == "avx512");
}
