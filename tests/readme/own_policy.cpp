// SPDX-License-Identifier: MIT
#include <tsubu/testing/id_storage_conformance.hpp>
#include <tsubu/tsubu.hpp>

#include <cstdio>
#include <map>

struct tree_storage {
    using id_type = std::int64_t;
    std::map<id_type, tsubu::index_t> tree;

    tsubu::index_t find(id_type id) const noexcept {
        const auto at = tree.find(id);
        return at == tree.end() ? tsubu::absent : at->second;
    }
    std::size_t size() const noexcept { return tree.size(); }
    std::size_t memory_bytes() const noexcept { return tree.size() * 48; }  // a node of libstdc++ and its header
    void assign(id_type id, tsubu::index_t index) { tree[id] = index; }
    bool erase(id_type id) noexcept { return tree.erase(id) != 0; }
    void rebuild(std::span<const id_type> ids, tsubu::id_range<id_type>, std::span<tsubu::index_t> links) {
        std::map<id_type, tsubu::index_t> fresh;
        for (const auto id : ids) fresh.try_emplace(id, tsubu::absent);  // without memory all stays as it was
        for (auto i = ids.size(); i-- > 0;) {                            // backwards: the lowest index stays
            const auto next = std::exchange(fresh.find(ids[i])->second, static_cast<tsubu::index_t>(i));
            if (!links.empty()) links[i] = next;
        }
        tree.swap(fresh);
    }
    void reserve(std::size_t) {}
    void clear() noexcept { tree.clear(); }
};
static_assert(tsubu::id_storage<tree_storage>);

int main() {
    bool kept_all = true;
    tsubu::testing::check_id_storage<tree_storage>(7, 200, [&](bool kept, std::string_view law) {
        if (!kept) std::printf("%s\n", std::string(law).c_str());
        kept_all = kept_all && kept;
    });
    return kept_all ? 0 : 1;
}
