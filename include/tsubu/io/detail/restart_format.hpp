// SPDX-License-Identifier: MIT
/// @file
/// The words of a restart file: its header, and the header of a block.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/checksum.hpp>
#include <tsubu/io/detail/restart_layout.hpp>
#include <tsubu/io/detail/type_text.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/store/field.hpp>

#include <algorithm>    // std::min
#include <array>        // std::array
#include <bit>          // std::bit_cast
#include <cstddef>      // offsetof, std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::remove_cv_t
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu::detail {

// A restart file, in words of 64 bits, in the byte order of the machine that wrote it:
//
//     header   magic | byte order | version | words of the header | bytes of the file | particles per block | step |
//              dimension | periodic | lo 3 | hi 3 | lengths 3 | tilts 3 | user words: how many, ... |
//              fields: how many, each: name, type, unit | parts: how many, each: particles, blocks, bytes | checksum
//     part 0   block 0: magic | part | block | particles | words | checksum of the body | checksum of the file's header
//     |
//                       checksum of these seven | body: particles as pack() lays them
//              block 1 ...
//     part 1 ...
//
// A text is its length in bytes, and its bytes, zeros up to the next word. Parts follow one another without gaps, so
// where each begins is a sum, and where the last one ends is the end of the file. Every bit is under a checksum or
// compared with what it must be; that of the header is in each block, so blocks of other files are not taken for this
// one's.

inline constexpr auto restart_magic =  // a byte above 127 and a line end, which transfers as text would change
    std::bit_cast<std::uint64_t>(std::array<unsigned char, 8>{0x89, 't', 's', 'u', 'b', 'u', '\r', '\n'});
inline constexpr auto restart_block_magic =
    std::bit_cast<std::uint64_t>(std::array<unsigned char, 8>{'p', 'a', 'r', 't', 'i', 'c', 'l', 'e'});
inline constexpr std::uint64_t restart_byte_order = 0x0102030405060708;
inline constexpr std::uint64_t restart_other_byte_order = 0x0807060504030201;
inline constexpr std::uint64_t restart_version = 1;  // of all this, and of the words that pack() writes
inline constexpr std::size_t restart_least_header = 5;  // magic .. bytes of the file
inline constexpr std::uint64_t word_bytes = sizeof(std::uint64_t);

/// In front of each block.
struct restart_block {
    std::uint64_t magic = restart_block_magic;
    std::uint64_t part = 0;
    std::uint64_t number = 0;  // in its part
    std::uint64_t particles = 0;
    std::uint64_t words = 0;  // of the body
    std::uint64_t body_checksum = 0;
    std::uint64_t file_checksum = 0;  // of the file's header
    std::uint64_t checksum = 0;       // of those before
    [[nodiscard]] std::uint64_t own_checksum() const noexcept {
        return crc64_of(std::as_bytes(std::span(this, 1)).first(offsetof(restart_block, checksum)));
    }
};
inline constexpr std::size_t restart_block_header = sizeof(restart_block) / word_bytes;
static_assert(restart_block_header == 8);

struct restart_header {
    restart_state state;
    std::uint64_t particles_per_block = 0;
    std::vector<restart_field> fields;
    std::vector<restart_part> parts;
    std::uint64_t words = 0;     // of the header
    std::uint64_t bytes = 0;     // of the file
    std::uint64_t checksum = 0;  // of the header
};

template <auto... F>
[[nodiscard]] std::vector<restart_field> restart_fields(fields<F...>) {
    return {restart_field{std::string(std::remove_cv_t<decltype(F)>::name),
                          type_text_of<typename std::remove_cv_t<decltype(F)>::value_type>::get(),
                          std::string(std::remove_cv_t<decltype(F)>::unit)}...};
}

class restart_words {
public:
    void put(std::uint64_t word) { words_.push_back(word); }
    void put(const vec<3>& numbers) {
        for (const auto x : numbers) put(std::bit_cast<std::uint64_t>(x));
    }
    void put(std::string_view text) {
        put(text.size());
        const auto at = words_.size();
        words_.resize(at + (text.size() + 7) / 8);
        if (!text.empty()) std::memcpy(words_.data() + at, text.data(), text.size());
    }
    [[nodiscard]] std::vector<std::uint64_t>& words() noexcept { return words_; }

private:
    std::vector<std::uint64_t> words_;
};

/// The header in words; header.words, bytes and checksum are set.
[[nodiscard]] inline std::vector<std::uint64_t> encode(restart_header& header) {
    restart_words to;
    to.put(restart_magic);
    to.put(restart_byte_order);
    to.put(restart_version);
    to.put(0);
    to.put(0);
    to.put(header.particles_per_block);
    to.put(static_cast<std::uint64_t>(header.state.step));
    const auto& box = header.state.box;
    to.put(box.dimension);
    to.put((box.periodic[0] ? 1U : 0U) | (box.periodic[1] ? 2U : 0U) | (box.periodic[2] ? 4U : 0U));
    for (const auto* numbers : {&box.lo, &box.hi, &box.lengths, &box.tilts}) to.put(*numbers);
    to.put(header.state.words.size());
    for (const auto word : header.state.words) to.put(word);
    to.put(header.fields.size());
    for (const auto& field : header.fields)
        for (const auto* text : {&field.name, &field.type, &field.unit}) to.put(std::string_view(*text));
    to.put(header.parts.size());
    for (const auto& part : header.parts)
        for (const auto number : {part.particles, part.blocks, part.bytes}) to.put(number);
    auto& words = to.words();
    header.words = words.size() + 1;
    header.bytes = word_bytes * header.words;
    for (const auto& part : header.parts) header.bytes += part.bytes;
    words[3] = header.words;
    words[4] = header.bytes;
    header.checksum = crc64_of(words);
    to.put(header.checksum);
    return std::move(words);
}

/// Refuses a file: "run.restart: byte 4096: ...; remedy".
[[noreturn, gnu::cold]] inline void refuse_restart(std::string_view name, std::uint64_t byte, const std::string& reason,
                                                   const char* remedy = "the file is damaged; take an older one") {
    raise<input_error>("restart_reader", std::string(name) + ": byte " + std::to_string(byte) + ": " + reason, remedy);
}

/// Takes words from a header whose checksum was right; what it says is still not believed.
class restart_cursor {
public:
    restart_cursor(std::span<const std::uint64_t> words, std::size_t at, std::string_view name)
        : words_(words), at_(at), name_(name) {}
    [[nodiscard]] std::uint64_t word() {
        if (left() == 0) refuse("the header ends too early");
        return words_[at_++];
    }
    /// How many things follow that take at least so many words each.
    [[nodiscard]] std::size_t count(std::size_t least) {
        const auto n = word();
        if (n > left() / least) refuse("the header cannot hold " + std::to_string(n) + " entries");
        return static_cast<std::size_t>(n);
    }
    [[nodiscard]] vec<3> numbers() {
        vec<3> x{};
        for (auto& entry : x) entry = std::bit_cast<double>(word());
        return x;
    }
    [[nodiscard]] std::string text() {
        const auto bytes = word();
        if (bytes > word_bytes * left()) refuse("the header cannot hold a text of " + std::to_string(bytes) + " bytes");
        std::string text(static_cast<std::size_t>(bytes), '\0');
        if (!text.empty()) std::memcpy(text.data(), words_.data() + at_, text.size());
        at_ += (text.size() + 7) / 8;
        return text;
    }
    [[nodiscard]] std::size_t left() const noexcept { return words_.size() - at_; }
    [[noreturn]] void refuse(const std::string& reason) const { refuse_restart(name_, 8 * at_, reason); }

private:
    std::span<const std::uint64_t> words_;
    std::size_t at_;
    std::string_view name_;
};

/// Reads and checks the header; parts lie inside the file then, and numbers of particles and blocks fit their bytes.
/// Memory: a header of the file's length at most.
template <byte_source Source>
[[nodiscard]] restart_header decode(const Source& source) {
    const std::string_view name = source.name();
    const auto size = source.size();
    std::array<std::uint64_t, restart_least_header> begin{};
    constexpr auto begin_bytes = word_bytes * restart_least_header;
    const auto has = static_cast<std::size_t>((std::min<std::uint64_t>)(size, begin_bytes));
    source.read(0, std::as_writable_bytes(std::span(begin)).first(has));
    if (has < 8 || begin[0] != restart_magic)
        refuse_restart(name, 0, "this is no restart file of tsubu", "give one that write_restart has written");
    if (has == begin_bytes && begin[1] == restart_other_byte_order)
        refuse_restart(name, 8, "written on a machine of the other byte order", "read it on such a machine");
    if (has == begin_bytes && begin[1] != restart_byte_order)
        refuse_restart(name, 8, "the mark of the byte order differs");
    if (has == begin_bytes && begin[2] != restart_version)
        refuse_restart(name, 16,
                       "format version " + std::to_string(begin[2]) + "; this is a reader of version " +
                           std::to_string(restart_version),
                       "read it with the version of tsubu that wrote it");
    restart_header header;
    header.words = begin[3];
    header.bytes = begin[4];
    if (has < begin_bytes || header.words > size / word_bytes)
        refuse_restart(name, size, "the file ends in its header", "it is not whole; take an older one");
    if (header.words <= restart_least_header) refuse_restart(name, 24, "the length of the header cannot be right");
    std::vector<std::uint64_t> words(static_cast<std::size_t>(header.words));
    source.read(0, std::as_writable_bytes(std::span(words)));
    const auto checked = std::span<const std::uint64_t>(words).first(words.size() - 1);
    header.checksum = words.back();
    if (crc64_of(checked) != header.checksum) refuse_restart(name, 0, "the checksum of the header differs");
    if (header.bytes != size)
        refuse_restart(name, (std::min)(size, header.bytes),
                       "the file has " + std::to_string(size) + " bytes; its header says " +
                           std::to_string(header.bytes),
                       size < header.bytes ? "it is not whole; take an older one"
                                           : "something was appended to it; take an older one");

    restart_cursor from(checked, restart_least_header, name);
    header.particles_per_block = from.word();
    header.state.step = static_cast<std::int64_t>(from.word());
    auto& box = header.state.box;
    box.dimension = static_cast<std::size_t>(from.word());
    const auto periodic = from.word();
    if (box.dimension > 3 || periodic > 7) from.refuse("a box of " + std::to_string(box.dimension) + " dimensions");
    for (std::size_t k = 0; k < 3; ++k) box.periodic[k] = ((periodic >> k) & 1) != 0;
    for (auto* numbers : {&box.lo, &box.hi, &box.lengths, &box.tilts}) *numbers = from.numbers();
    header.state.words.resize(from.count(1));
    for (auto& word : header.state.words) word = from.word();
    header.fields.resize(from.count(3));
    for (auto& field : header.fields)
        for (auto* text : {&field.name, &field.type, &field.unit}) *text = from.text();
    header.parts.resize(from.count(3));
    auto end = word_bytes * header.words;
    for (auto& part : header.parts) {
        for (auto* number : {&part.particles, &part.blocks, &part.bytes}) *number = from.word();
        if (part.bytes > size - end) from.refuse("a part that reaches beyond the file");
        // Each particle takes a word, each block its header.
        if (part.particles > part.bytes / word_bytes || part.blocks > part.bytes / sizeof(restart_block))
            from.refuse("a part of " + std::to_string(part.bytes) + " bytes for " + std::to_string(part.particles) +
                        " particles in " + std::to_string(part.blocks) + " blocks");
        end += part.bytes;
    }
    if (from.left() != 0) from.refuse("the header goes on after its end");
    if (end != size) from.refuse("the parts do not fill the file");
    return header;
}

[[nodiscard]] inline std::string listed(const std::vector<restart_field>& fields) {
    std::string text;
    for (const auto& field : fields) text += (text.empty() ? "" : ", ") + field.name;
    return text.empty() ? "none" : text;
}
[[nodiscard]] inline std::string of_unit(const restart_field& field) {
    return field.type + (field.unit.empty() ? " without a unit" : " in " + field.unit);
}

/// Refuses a file that lacks wanted fields, or has them of other types or units; all of them by name.
inline void check_fields(std::string_view name, const std::vector<restart_field>& in_file,
                         const std::vector<restart_field>& wanted) {
    const auto refuse = [&](const std::string& reason, const char* remedy) {
        raise<input_error>("restart_reader", std::string(name) + ": " + reason, remedy);
    };
    const auto found = [&](const std::string& field) {
        const restart_field* at = nullptr;
        for (const auto& candidate : in_file)
            if (at == nullptr && candidate.name == field) at = &candidate;
        return at;
    };
    std::string missing;
    for (const auto& field : wanted)
        if (found(field.name) == nullptr) missing += (missing.empty() ? "" : ", ") + field.name;
    if (!missing.empty())
        refuse("the file has no field " + missing + "; it has " + listed(in_file), "read the fields that were written");
    for (const auto& field : wanted)
        if (const auto& other = *found(field.name); other != field)
            refuse("the field " + field.name + " is " + of_unit(other) + "; asked for was " + of_unit(field),
                   "read the fields that were written");
    if (in_file == wanted) return;
    for (const auto& field : in_file)
        if (!words_of_type(field.type))
            refuse("the field " + field.name + " is " + field.type + ", of which the size is not known",
                   "read all fields of the file, in its order");
}

}  // namespace tsubu::detail
