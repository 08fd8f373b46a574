// SPDX-License-Identifier: MIT
/// @file
/// What a field is in HDF5: its type, its shape, and which types of a file it can be read from without loss.
#pragma once

#include <tsubu/io/detail/hdf5_library.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int8_t
#include <limits>       // std::numeric_limits
#include <string>       // std::string, std::to_string
#include <type_traits>  // std::is_arithmetic_v, std::is_enum_v, std::is_same_v, std::underlying_type_t
#include <vector>       // std::vector

namespace tsubu::detail {

/// Numbers that HDF5 has a type for on every machine: up to 64 bits.
template <class Number>
concept hdf5_number = std::is_arithmetic_v<Number> && sizeof(Number) <= 8;

/// Lists, bonuses and records are none.
template <class Value>
struct hdf5_value {
    static constexpr bool exists = false;
};
template <hdf5_number Value>
struct hdf5_value<Value> {
    static constexpr bool exists = true;
    using scalar = Value;
    static std::vector<hsize_t> extents() { return {}; }
};
template <class Value>
    requires std::is_enum_v<Value>
struct hdf5_value<Value> : hdf5_value<std::underlying_type_t<Value>> {};
/// Arrays of arrays too: tensors.
template <class Value, std::size_t N>
    requires(N > 0 && hdf5_value<Value>::exists)
struct hdf5_value<std::array<Value, N>> {
    static constexpr bool exists = true;
    using scalar = typename hdf5_value<Value>::scalar;
    static std::vector<hsize_t> extents() {
        auto inner = hdf5_value<Value>::extents();
        inner.insert(inner.begin(), N);
        return inner;
    }
};

/// As HDF5 holds it in memory. A bool is FALSE or TRUE of 8 bits, what h5py makes of numpy's.
template <hdf5_number Number>
[[nodiscard]] hdf5_object hdf5_type_of() {
    if constexpr (std::is_same_v<Number, bool>) {
        static_assert(sizeof(bool) == 1);
        hdf5_object type(H5Tenum_create(H5T_NATIVE_INT8));
        std::int8_t value = 0;
        H5Tenum_insert(type.get(), "FALSE", &value);
        value = 1;
        H5Tenum_insert(type.get(), "TRUE", &value);
        return type;
    } else if constexpr (std::is_floating_point_v<Number>) {
        return hdf5_object(H5Tcopy(sizeof(Number) == 4 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE));
    } else if constexpr (std::is_signed_v<Number>) {
        return hdf5_object(H5Tcopy(sizeof(Number) == 1   ? H5T_NATIVE_INT8
                                   : sizeof(Number) == 2 ? H5T_NATIVE_INT16
                                   : sizeof(Number) == 4 ? H5T_NATIVE_INT32
                                                         : H5T_NATIVE_INT64));
    } else {
        return hdf5_object(H5Tcopy(sizeof(Number) == 1   ? H5T_NATIVE_UINT8
                                   : sizeof(Number) == 2 ? H5T_NATIVE_UINT16
                                   : sizeof(Number) == 4 ? H5T_NATIVE_UINT32
                                                         : H5T_NATIVE_UINT64));
    }
}

/// What stands where no particle is: of an id what no particle has, of other numbers what nobody takes for a value.
template <hdf5_number Number>
[[nodiscard]] constexpr Number hdf5_fill(bool is_id) noexcept {
    if constexpr (std::is_floating_point_v<Number>)
        return std::numeric_limits<Number>::quiet_NaN();
    else if constexpr (std::is_signed_v<Number>)
        return is_id ? Number(-1) : Number(0);
    else
        return is_id ? (std::numeric_limits<Number>::max)() : Number(0);
}

/// The type of a dataset, or of an attribute.
struct hdf5_kind {
    H5T_class_t type_class = H5T_NO_CLASS;
    std::size_t bytes = 0;
    bool is_signed = false;

    [[nodiscard]] static hdf5_kind of(hid_t type) {
        hdf5_kind kind{H5Tget_class(type), H5Tget_size(type), false};
        if (kind.type_class == H5T_INTEGER) {
            kind.is_signed = H5Tget_sign(type) == H5T_SGN_2;
        } else if (kind.type_class == H5T_ENUM) {
            const hdf5_object base(H5Tget_super(type));
            kind.is_signed = H5Tget_sign(base.get()) == H5T_SGN_2;
        }
        return kind;
    }
    [[nodiscard]] bool is_integer() const noexcept { return type_class == H5T_INTEGER || type_class == H5T_ENUM; }
    /// Whether each of its values is one of this number.
    template <hdf5_number Number>
    [[nodiscard]] bool fits() const noexcept {
        if constexpr (std::is_same_v<Number, bool>)
            return is_integer() && bytes == 1;  // its values are looked at
        else if constexpr (std::is_floating_point_v<Number>)
            return type_class == H5T_FLOAT && bytes <= sizeof(Number);
        else if (!is_integer())
            return false;
        else if constexpr (std::is_signed_v<Number>)
            return is_signed ? bytes <= sizeof(Number) : bytes < sizeof(Number);
        else
            return !is_signed && bytes <= sizeof(Number);
    }
    [[nodiscard]] std::string text() const {
        switch (type_class) {
            case H5T_INTEGER: return std::string(is_signed ? "int" : "uint") + std::to_string(8 * bytes);
            case H5T_ENUM:
                return std::string("enumeration of ") + (is_signed ? "int" : "uint") + std::to_string(8 * bytes);
            case H5T_FLOAT: return "float" + std::to_string(8 * bytes);
            case H5T_STRING: return "text";
            case H5T_COMPOUND: return "records";
            case H5T_REFERENCE: return "references";
            default: return "another type";
        }
    }
};

/// [4, 100, 3]
[[nodiscard]] inline std::string shown_extents(const std::vector<hsize_t>& extents) {
    std::string text = "[";
    for (const auto extent : extents) {
        if (text.size() > 1) text += ", ";
        text += std::to_string(extent);
    }
    return text + "]";
}

}  // namespace tsubu::detail
