// SPDX-License-Identifier: MIT
/// @file
/// The particle ids of a LAMMPS data file (section Atoms) or dump file (first ITEM: ATOMS), in the order of the file.
#pragma once

#include "id_set.hpp"

#include <algorithm>     // std::adjacent_find, std::sort
#include <cctype>        // std::isalpha
#include <charconv>      // std::from_chars
#include <cstddef>       // std::size_t
#include <fstream>       // std::ifstream
#include <sstream>       // std::istringstream
#include <stdexcept>     // std::runtime_error
#include <string>        // std::string
#include <system_error>  // std::errc
#include <vector>        // std::vector

namespace bench {

/// In which column of "ITEM: ATOMS id type x ..." the ids stand.
[[nodiscard]] inline int dump_id_column(const std::string& header, const std::string& path) {
    std::istringstream words(header.substr(std::string("ITEM: ATOMS").size()));
    std::string word;
    for (int column = 0; words >> word; ++column)
        if (word == "id") return column;
    throw std::runtime_error(path + ": \"ITEM: ATOMS\" has no column \"id\"; write the dump with one");
}

/// @throws std::runtime_error if it is no id.
[[nodiscard]] inline id_t id_in(const std::string& word, const std::string& path, std::size_t line) {
    id_t id = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), id);
    if (fault != std::errc{} || end != word.data() + word.size() || id < 0)
        throw std::runtime_error(path + ":" + std::to_string(line) + ": \"" + word +
                                 "\" is no id; ids are whole numbers from 0 to 2^63 - 1");
    return id;
}

[[nodiscard]] inline std::vector<id_t> read_lammps_ids(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read; name a LAMMPS data or dump file");
    std::vector<id_t> ids;
    int column = -1;  // >= 0 inside the section
    bool dump = false;
    std::string line;
    std::size_t number = 0;
    while (std::getline(file, line)) {
        ++number;
        const auto begin = line.find_first_not_of(" \t\r");
        const bool item = line.compare(0, 5, "ITEM:") == 0;
        const bool heading = begin != std::string::npos && std::isalpha(static_cast<unsigned char>(line[begin])) != 0;
        if (column >= 0 && (item || (heading && !dump))) break;  // the next snapshot, or the next section
        if (number == 1 && !item) continue;                      // the title of a data file, whatever it says
        if (column < 0 && heading) {
            dump = line.compare(0, 11, "ITEM: ATOMS") == 0;
            if (dump) column = dump_id_column(line, path);
            if (line.compare(begin, 5, "Atoms") == 0) column = 0;
            continue;
        }
        if (column < 0 || begin == std::string::npos) continue;
        std::istringstream words(line);
        std::string word;
        for (int k = 0; k <= column; ++k) words >> word;
        ids.push_back(id_in(word, path, number));
    }
    if (ids.size() < 100)
        throw std::runtime_error(path + ": " + std::to_string(ids.size()) +
                                 " ids found; name a LAMMPS data file with a section Atoms, or a dump file in text "
                                 "form, of at least 100 particles");
    auto sorted = ids;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
        throw std::runtime_error(path + ": id " + std::to_string(*twice) +
                                 " is there twice; give each particle its own");
    return ids;
}

/// The ids of a file as those of one rank: the first 1 / 1.15 of them owned, the rest ghosts.
[[nodiscard]] inline id_set from_lammps(const std::string& path, std::size_t& owned) {
    id_set set;
    set.ids = read_lammps_ids(path);
    owned = set.ids.size() * 100 / 115;
    while (different_ids(owned) > set.ids.size()) --owned;
    set.ids.resize(different_ids(owned));
    set.elsewhere = gaps_between(set.ids, set.ids.size(), 1);
    return set;
}

}  // namespace bench
