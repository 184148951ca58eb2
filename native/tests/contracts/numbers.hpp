// The numbers in arguments and results, one after the other, whatever the types.
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace motus::contracts {

/// A struct's numbers are those of its fields: an overload of fields(Declared, T&) in this namespace, which
/// is found because Declared is of it, ties them.
struct Declared {};
template <class T, class Of>
concept Some = std::same_as<std::remove_const_t<T>, Of>;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T, std::size_t extent>
inline constexpr bool is_list<std::span<T, extent>> = true;
template <class T, std::size_t size>
inline constexpr bool is_list<std::array<T, size>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_tuple = false;
template <class... T>
inline constexpr bool is_tuple<std::tuple<T...>> = true;
template <class A, class B>
inline constexpr bool is_tuple<std::pair<A, B>> = true;
template <class T>
inline constexpr bool is_glm = false;
template <glm::length_t n, class T, glm::qualifier q>
inline constexpr bool is_glm<glm::vec<n, T, q>> = true;
template <class T, glm::qualifier q>
inline constexpr bool is_glm<glm::qua<T, q>> = true;
template <glm::length_t c, glm::length_t r, class T, glm::qualifier q>
inline constexpr bool is_glm<glm::mat<c, r, T, q>> = true;

/// Calls visit(number) for each number in a value, in order. Choices and flags are no numbers.
template <class T, class Visit>
void each_number(T& value, const Visit& visit) {
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_enum_v<Plain> || std::same_as<Plain, bool>) {
        return;
    } else if constexpr (std::is_arithmetic_v<Plain>) {
        visit(value);
    } else if constexpr (is_glm<Plain>) {
        for (glm::length_t i = 0; i < Plain::length(); ++i) each_number(value[i], visit);
    } else if constexpr (is_list<Plain>) {
        for (auto& one : value) each_number(one, visit);
    } else if constexpr (is_optional<Plain>) {
        if (value) each_number(*value, visit);
    } else if constexpr (is_tuple<Plain>) {
        std::apply([&](auto&... one) { (each_number(one, visit), ...); }, value);
    } else {
        std::apply([&](auto&... one) { (each_number(one, visit), ...); }, fields(Declared{}, value));
    }
}

/// A number of an argument, which can be changed.
class Place {
  public:
    using Pointer =
        std::variant<double*, float*, int*, unsigned*, std::int64_t*, std::uint64_t*, char*, unsigned char*>;
    explicit Place(Pointer pointer) : pointer_(pointer) {}

    [[nodiscard]] bool is_whole() const { return pointer_.index() > 1; }
    [[nodiscard]] double get() const {
        return std::visit([](const auto* number) { return static_cast<double>(*number); }, pointer_);
    }
    /// The number of this type that is nearest; false if it was this one before.
    bool set(double wanted) const {
        return std::visit(
            [&]<class Number>(Number* number) {
                const Number before = *number;
                *number = nearest<Number>(wanted);
                return !(before == *number && std::signbit(static_cast<double>(before)) ==
                                                  std::signbit(static_cast<double>(*number)));
            },
            pointer_);
    }

  private:
    template <class Number>
    [[nodiscard]] static Number nearest(double wanted) {
        using Limits = std::numeric_limits<Number>;
        if constexpr (std::same_as<Number, float>) {
            if (std::abs(wanted) > Limits::max())
                return std::copysign(Limits::infinity(), static_cast<float>(wanted < 0 ? -1 : 1));
            return static_cast<float>(wanted);
        } else if constexpr (!std::same_as<Number, double>) {
            if (wanted <= static_cast<double>(Limits::lowest())) return Limits::lowest();
            if (wanted >= static_cast<double>(Limits::max())) return Limits::max();
            return static_cast<Number>(wanted);
        } else {
            return wanted;
        }
    }
    Pointer pointer_;
};

}  // namespace motus::contracts
