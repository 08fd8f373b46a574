// SPDX-License-Identifier: MIT
/// @file
/// restart_layout: where each field lies among the words of a particle in a restart file; some of them, in another
/// order.
#pragma once

#include <tsubu/io/restart_state.hpp>

#include <charconv>     // std::from_chars
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <optional>     // std::optional
#include <span>         // std::span
#include <string_view>  // std::string_view
#include <system_error> // std::errc
#include <utility>      // std::pair
#include <vector>       // std::vector

namespace tsubu::detail {

/// What the text of a type says of its words, as type_text_of writes it.
struct restart_words_of {
    enum class kind { fixed, list, bonus };
    kind is;
    std::size_t bytes;  ///< of the value, or of one element
    [[nodiscard]] std::size_t words() const noexcept { return (bytes + 7) / 8; }
};

/// Bytes of "int32", "float64[3]", "record of 24 bytes"; 0 if it is none of these.
[[nodiscard]] inline std::size_t bytes_of_value(std::string_view type) noexcept {
    constexpr std::size_t most = std::size_t{1} << 20;  // of a file that someone else has made
    const auto number = [&](std::string_view text) {
        std::size_t n = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), n);
        return code == std::errc{} && end == text.data() + text.size() && n <= most ? n : 0;
    };
    std::size_t count = 1;
    while (type.ends_with(']')) {
        const auto open = type.rfind('[');
        if (open == std::string_view::npos) return 0;
        count *= number(type.substr(open + 1, type.size() - open - 2));
        if (count > most) return 0;
        type = type.substr(0, open);
    }
    if (type == "bool") return count;
    constexpr std::string_view record = "record of ";
    constexpr std::string_view unit = " bytes";
    if (type.starts_with(record) && type.ends_with(unit) && type.size() > record.size() + unit.size())
        return count * number(type.substr(record.size(), type.size() - record.size() - unit.size()));
    for (const std::string_view scalar : {"int", "uint", "float"})
        if (type.starts_with(scalar)) return count * (number(type.substr(scalar.size())) / 8);
    return 0;
}
/// Nothing if the text is that of no type.
[[nodiscard]] inline std::optional<restart_words_of> words_of_type(std::string_view type) noexcept {
    using kind = restart_words_of::kind;
    auto is = kind::fixed;
    for (const auto& [prefix, other] : {std::pair{std::string_view("list of "), kind::list},
                                        std::pair{std::string_view("bonus of "), kind::bonus}})
        if (type.starts_with(prefix)) {
            is = other;
            type.remove_prefix(prefix.size());
            break;
        }
    const auto bytes = bytes_of_value(type);
    if (bytes == 0) return std::nullopt;
    return restart_words_of{is, bytes};
}

/// The words of particles as a file has them, and as pack() lays them for the fields that are wanted:
///
///     file    | id | x y z | radius | bonds: 2 | b b | shape: 0 |
///     wanted  | radius | id | shape: 0 |
class restart_layout {
public:
    /// Precondition: the types of all fields in the file are known, and each wanted one is among them.
    restart_layout(std::span<const restart_field> in_file, std::span<const restart_field> wanted) {
        std::vector<std::size_t> begins;  // of a fixed field its first word, of another its number among those
        for (const auto& field : in_file) {
            const auto words = *words_of_type(field.type);
            if (words.is == restart_words_of::kind::fixed) {
                begins.push_back(fixed_);
                fixed_ += words.words();
            } else {
                begins.push_back(varying_.size());
                varying_.push_back(words);
            }
        }
        for (const auto& field : wanted)
            for (std::size_t k = 0; k < in_file.size(); ++k) {
                if (in_file[k].name != field.name) continue;
                const auto words = *words_of_type(field.type);
                if (words.is == restart_words_of::kind::fixed)
                    wanted_fixed_.push_back({begins[k], words.words()});
                else
                    wanted_varying_.push_back(begins[k]);
                break;
            }
    }
    /// The words of a particle with empty lists in the file.
    [[nodiscard]] std::uint64_t least() const noexcept { return fixed_ + varying_.size(); }
    /// Appends the wanted words of `count` particles. @return how many words those of the file are; nothing if they end
    /// too early or say what cannot be.
    [[nodiscard]] std::optional<std::size_t> choose(std::span<const std::uint64_t> words, std::size_t count,
                                                    std::vector<std::uint64_t>& to) const {
        std::vector<stretch> found(varying_.size());
        std::size_t at = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (words.size() - at < least()) return std::nullopt;
            const auto first = at;
            at += fixed_;
            for (std::size_t k = 0; k < varying_.size(); ++k) {
                const auto length = words_at(words.subspan(at), varying_[k]);
                if (!length) return std::nullopt;
                found[k] = {at, *length};
                at += *length;
            }
            for (const auto& [begin, length] : wanted_fixed_) append(to, words.subspan(first + begin, length));
            for (const auto k : wanted_varying_) append(to, words.subspan(found[k].begin, found[k].length));
        }
        return at;
    }

private:
    struct stretch {
        std::size_t begin;
        std::size_t length;
    };
    /// Of a list, or of what only some have: the word that says how many, and they.
    [[nodiscard]] static std::optional<std::size_t> words_at(std::span<const std::uint64_t> words,
                                                             const restart_words_of& kind) noexcept {
        if (words.empty()) return std::nullopt;
        const auto left = words.size() - 1;
        const auto count = words[0];
        if (kind.is == restart_words_of::kind::bonus) {
            if (count > 1 || (count == 1 && kind.words() > left)) return std::nullopt;
            return count == 0 ? 1 : 1 + kind.words();
        }
        if (count > 8 * left / kind.bytes) return std::nullopt;
        return 1 + (static_cast<std::size_t>(count) * kind.bytes + 7) / 8;
    }
    static void append(std::vector<std::uint64_t>& to, std::span<const std::uint64_t> words) {
        to.insert(to.end(), words.begin(), words.end());
    }

    std::size_t fixed_ = 0;
    std::vector<restart_words_of> varying_;
    std::vector<stretch> wanted_fixed_;
    std::vector<std::size_t> wanted_varying_;
};

}  // namespace tsubu::detail
