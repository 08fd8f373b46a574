// SPDX-License-Identifier: MIT
/// @file
/// The particle ids of a LAMMPS data file (section Atoms) or dump file (first ITEM: ATOMS), in the order of the file.
#pragma once

#include "id_set.hpp"

#include <cctype>     // std::isalpha
#include <cstddef>    // std::size_t
#include <fstream>    // std::ifstream
#include <sstream>    // std::istringstream
#include <stdexcept>  // std::runtime_error
#include <string>     // std::string
#include <vector>     // std::vector

namespace bench {

/// In which column of "ITEM: ATOMS id type x ..." the ids stand.
[[nodiscard]] inline int dump_id_column(const std::string& header, const std::string& path) {
    std::istringstream words(header.substr(std::string("ITEM: ATOMS").size()));
    std::string word;
    for (int column = 0; words >> word; ++column)
        if (word == "id") return column;
    throw std::runtime_error(path + ": \"ITEM: ATOMS\" has no column \"id\"; write the dump with one");
}

[[nodiscard]] inline std::vector<id_t> read_lammps_ids(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read; name a LAMMPS data or dump file");
    std::vector<id_t> ids;
    int column = -1;  // >= 0 inside the section
    bool dump = false;
    std::string line;
    while (std::getline(file, line)) {
        const auto begin = line.find_first_not_of(" \t\r");
        const bool item = line.compare(0, 5, "ITEM:") == 0;
        const bool heading = begin != std::string::npos && std::isalpha(static_cast<unsigned char>(line[begin])) != 0;
        if (column >= 0 && (item || (heading && !dump))) break;  // the next snapshot, or the next section
        if (column < 0 && heading) {
            dump = line.compare(0, 11, "ITEM: ATOMS") == 0;
            if (dump) column = dump_id_column(line, path);
            if (line.compare(begin, 5, "Atoms") == 0) column = 0;
            continue;
        }
        if (column < 0 || begin == std::string::npos) continue;
        std::istringstream words(line);
        std::string skipped;
        id_t id = 0;
        for (int k = 0; k < column; ++k) words >> skipped;
        if (words >> id) ids.push_back(id);
    }
    if (ids.size() < 100)
        throw std::runtime_error(path + ": " + std::to_string(ids.size()) +
                                 " ids found; name a LAMMPS data file with a section Atoms, or a dump file in text "
                                 "form, of at least 100 particles");
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
