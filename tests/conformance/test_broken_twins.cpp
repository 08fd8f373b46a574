// SPDX-License-Identifier: MIT
/// @file
/// Does the conformance suite catch what it is there for?
#include "broken_twins.hpp"

#include <tsubu/testing/archetypes.hpp>
#include <tsubu/testing/id_storage_conformance.hpp>

#include "support/catch.hpp"

#include <set>
#include <string>

namespace {

using namespace tsubu::testing;

/// The laws that were broken, by what stands before the colon.
struct verdict {
    void operator()(bool kept, std::string_view law) {
        ++checked;
        if (!kept) broken.insert(std::string(law.substr(0, law.find(':'))));
    }
    std::size_t checked = 0;
    std::set<std::string> broken;
};

std::string joined(const std::set<std::string>& laws) {
    std::string text;
    for (const auto& law : laws) text += law + "; ";
    return text;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a broken twin is caught by the number of its law", "[id][conformance]", broken::twins) {
    verdict seen;
    check_id_storage<TestType>(1, 300, seen);
    INFO("breaks " << TestType::breaks << ", caught by " << joined(seen.broken));
    CHECK(seen.broken.count(TestType::breaks) == 1);
}

// Where nothing is optimised, steps take 30 times as long.
#if defined(NDEBUG)
constexpr std::size_t steps_without_memory = 20;
constexpr std::size_t steps_with_memory = 100;
#else
constexpr std::size_t steps_without_memory = 4;
constexpr std::size_t steps_with_memory = 10;
#endif

TEMPLATE_LIST_TEST_CASE("a twin that is broken only without memory is caught", "[id][conformance][T10]",
                        broken::gated_twins) {
    verdict seen;
    check_id_storage_allocation<TestType>(1, steps_without_memory, seen);
    INFO("breaks " << TestType::breaks << ", caught by " << joined(seen.broken));
    CHECK(seen.broken.count(TestType::breaks) == 1);
    verdict with_memory;
    check_id_storage<TestType>(1, steps_with_memory, with_memory);
    INFO("with memory it breaks " << joined(with_memory.broken));
    CHECK((with_memory.broken.empty() || TestType::breaks != std::string("law 8")));
}

TEMPLATE_TEST_CASE("what is not broken is not blamed", "[id][conformance]", minimal_id_storage<>,
                   minimal_id_storage<std::uint32_t>, reference_storage<>, reference_storage<std::int32_t>,
                   reference_storage<std::uint64_t>, broken::sound, broken::sound_gated) {
    verdict seen;
    check_id_storage<TestType>(1, 300, seen);
    INFO(joined(seen.broken));
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 10'000);
}

TEST_CASE("what is sound without memory is not blamed", "[id][conformance][T10]") {
    verdict seen;
    check_id_storage_allocation<broken::sound_gated>(1, steps_without_memory, seen);
    INFO(joined(seen.broken));
    CHECK(seen.broken.empty());
}

TEST_CASE("the text of a broken law names ids, step and seed", "[id][conformance]") {
    std::string text;
    check_id_storage<broken::erase_lies>(77, 1, [&](bool kept, std::string_view law) {
        if (!kept) text = law;
    });
    INFO(text);
    CHECK(text.rfind("law 5: erase says whether the id was there", 0) == 0);
    CHECK(text.find("ids: ") != std::string::npos);
    CHECK(text.find("seed 77") != std::string::npos);
}
