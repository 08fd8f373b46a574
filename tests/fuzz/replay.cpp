// SPDX-License-Identifier: MIT
// Calls a fuzzing target without a fuzzer: with the files that are named, and with 5000 inputs of a fixed seed.
#include <tsubu/core/random.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t size);

int main(int count, char** words) {
    for (int k = 1; k < count; ++k) {
        std::ifstream file(words[k], std::ios::binary);
        if (!file) {
            std::fprintf(stderr, "cannot open %s\n", words[k]);
            return 2;
        }
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    constexpr int inputs = 5000;
    tsubu::random_stream random(41);
    std::vector<std::uint8_t> input;
    for (int k = 0; k < inputs; ++k) {
        input.resize(random.below(random.below(8) == 0 ? 400 : 32));
        const bool small = random.below(2) == 0;  // small numbers pass more checks
        for (auto& byte : input)
            byte = static_cast<std::uint8_t>(random.below(small && random.below(3) != 0 ? 4 : 256));
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    std::printf("%d files and %d inputs of seed 41: nothing found\n", count - 1, inputs);
}
