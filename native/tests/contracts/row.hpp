// Makes a row of the table from a call and its good arguments.
#pragma once
#include <cstring>
#include <memory>
#include <span>
#include <tuple>
#include <utility>

#include "contracts/contract.hpp"

namespace motus::contracts {

/// A slot of an argument of type T, and how to reach its numbers.
template <class T>
struct TypedSlot {
    Slot slot;
    std::function<void(T&, std::vector<Place>&)> places;
    std::function<std::size_t(T&)> width;
    std::function<bool(T&, int)> resize;
};

/// An argument that a call is given.
template <class T>
struct Argument {
    T value;
    std::vector<TypedSlot<T>> slots;
};

template <class T>
[[nodiscard]] std::vector<Place> places_of(T& value) {
    std::vector<Place> all;
    each_number(value, [&](auto& number) { all.emplace_back(Place::Pointer(&number)); });
    return all;
}
template <class T>
[[nodiscard]] std::size_t width_of(T& value) {
    if constexpr (is_list<T>)
        return value.empty() ? 1 : std::max<std::size_t>(1, places_of(value.front()).size());
    else
        return std::max<std::size_t>(1, places_of(value).size());
}
template <class T>
bool resized(T& value, int by) {
    if constexpr (requires { value.push_back(value.back()); }) {
        if (by > 0)
            value.push_back(value.empty() ? typename T::value_type{} : value.back());
        else if (value.empty())
            return false;
        else
            value.pop_back();
        return true;
    } else {
        return false;
    }
}

/// An argument of numbers.
template <class T>
[[nodiscard]] Argument<T> arg(std::string name, T good, Domain domain, Size size = {}) {
    TypedSlot<T> only{{std::move(name), std::move(domain), std::move(size), false},
                      [](T& value, std::vector<Place>& out) { out = places_of(value); },
                      [](T& value) { return width_of(value); },
                      [](T& value, int by) { return resized(value, by); }};
    return {std::move(good), {std::move(only)}};
}

/// A member of a struct that is an argument.
template <class T, class Member>
[[nodiscard]] TypedSlot<T> member(std::string name, Member T::*pointer, Domain domain, Size size = {}) {
    return {{std::move(name), std::move(domain), std::move(size), false},
            [=](T& value, std::vector<Place>& out) { out = places_of(value.*pointer); },
            [=](T& value) { return width_of(value.*pointer); },
            [=](T& value, int by) { return resized(value.*pointer, by); }};
}

/// A member of each struct in a list that is an argument.
template <class T, class Member>
[[nodiscard]] TypedSlot<std::vector<T>> each(std::string name, Member T::*pointer, Domain domain,
                                             Size size = {}) {
    return {{std::move(name), std::move(domain), std::move(size), false},
            [=](std::vector<T>& list, std::vector<Place>& out) {
                for (T& one : list)
                    for (const Place& place : places_of(one.*pointer)) out.push_back(place);
            },
            [=](std::vector<T>& list) { return list.empty() ? 1 : width_of(list.front().*pointer); },
            [=](std::vector<T>& list, int by) { return resized(list, by); }};
}

/// A struct that is an argument.
template <class T, std::same_as<TypedSlot<T>>... Slots>
[[nodiscard]] Argument<T> of(T good, Slots... slots) {
    return {std::move(good), {std::move(slots)...}};
}

/// Room that a call writes to, and what stands around it.
template <class T>
struct Room {
    static constexpr std::size_t border = 4;
    std::vector<T> all;
    std::size_t size;
    explicit Room(std::size_t count) : all(count + 3 * border), size(count) {
        // No result has these bytes in each number; they are finite in every type.
        std::memset(static_cast<void*>(all.data()), 0x47, all.size() * sizeof(T));
    }
    /// With the bytes between members, which a copy of each element need not have.
    Room(const Room& other) : all(other.all.size()), size(other.size) {
        std::memcpy(static_cast<void*>(all.data()), other.all.data(), all.size() * sizeof(T));
    }
    Room& operator=(const Room& other) {
        if (this != &other) *this = Room(other);
        return *this;
    }
    Room(Room&&) noexcept = default;
    Room& operator=(Room&&) noexcept = default;
    ~Room() = default;
    [[nodiscard]] std::span<T> span() { return std::span<T>(all).subspan(border, size); }
};
template <class T>
[[nodiscard]] Argument<Room<T>> out(std::string name, std::size_t count, std::string as,
                                    bool or_none = false) {
    using R = Room<T>;
    Size size = as_many_as(std::move(as));
    size.or_none = or_none;
    TypedSlot<R> only{{std::move(name), {}, std::move(size), true},
                      [](R&, std::vector<Place>&) {},
                      [](R&) { return std::size_t{1}; },
                      [](R& room, int by) {
                          if (by < 0 && room.size == 0) return false;
                          room.size = by < 0 ? room.size - 1 : room.size + 1;
                          return true;
                      }};
    return {R(count), {std::move(only)}};
}

template <class T>
T& passed(T& value) {
    return value;
}
template <class T>
std::span<T> passed(Room<T>& room) {
    return room.span();
}

/// A call and its arguments.
template <class Call, class... T>
class Case final : public Trial {
  public:
    Case(Call call, const std::tuple<Argument<T>...>& arguments)
        : call_(std::move(call)), arguments_(arguments) {}

    std::vector<Place> places(std::size_t slot) override {
        std::vector<Place> found;
        at(slot, [&](auto& argument, auto& typed) { typed.places(argument.value, found); });
        return found;
    }
    std::size_t width(std::size_t slot) override {
        std::size_t found = 1;
        at(slot, [&](auto& argument, auto& typed) { found = typed.width(argument.value); });
        return found;
    }
    bool resize(std::size_t slot, int by) override {
        bool was = false;
        at(slot, [&](auto& argument, auto& typed) { was = typed.resize(argument.value, by); });
        return was;
    }
    void call() override {
        std::apply(
            [&](auto&... argument) {
                if constexpr (std::is_void_v<decltype(call_(passed(argument.value)...))>)
                    call_(passed(argument.value)...);
                else
                    result_ = call_(passed(argument.value)...);
            },
            arguments_);
    }
    std::vector<double> results() override {
        std::vector<double> all;
        [[maybe_unused]] const auto visit = [&](const auto& number) {
            all.push_back(static_cast<double>(number));
        };
        if (result_) each_number(*result_, visit);
        each_room([&](auto& room) {
            for (const auto& one : room.span()) each_number(one, visit);
        });
        return all;
    }
    bool is_untouched(bool at_all) override {
        bool is = true;
        each_room([&](auto& room) {
            using Element = typename std::decay_t<decltype(room.all)>::value_type;
            const auto* bytes = reinterpret_cast<const unsigned char*>(room.all.data());
            const std::size_t first = room.border * sizeof(Element),
                              last = first + room.size * sizeof(Element);
            for (std::size_t i = 0; i < room.all.size() * sizeof(Element); ++i)
                if ((at_all || i < first || i >= last) && bytes[i] != 0x47) is = false;
        });
        return is;
    }

  private:
    using Result = std::remove_cvref_t<decltype(std::declval<Call&>()(passed(std::declval<T&>())...))>;

    template <class Visit>
    void at(std::size_t slot, const Visit& visit) {
        std::apply(
            [&](auto&... argument) {
                [[maybe_unused]] const auto one = [&](auto& that) {
                    if (slot < that.slots.size()) visit(that, that.slots[slot]);
                    slot -= that.slots.size();  // wraps around once it was found
                };
                (one(argument), ...);
            },
            arguments_);
    }
    template <class Visit>
    void each_room(const Visit& visit) {
        [[maybe_unused]] const auto one = [&](auto& value) {
            if constexpr (requires { value.border; }) visit(value);
        };
        std::apply([&](auto&... argument) { (one(argument.value), ...); }, arguments_);
    }

    Call call_;
    std::tuple<Argument<T>...> arguments_;
    std::optional<std::conditional_t<std::is_void_v<Result>, std::tuple<>, Result>> result_;
};

/// Adds a row. The call is given the arguments in order: an Argument its value, a Room its span.
template <class Call, class... T>
Row& add(Table& table, std::string signature, Call call, Argument<T>... arguments) {
    Row row;
    row.signature = std::move(signature);
    [[maybe_unused]] const auto note = [&](const auto& argument) {
        for (const auto& typed : argument.slots) row.slots.push_back(typed.slot);
    };
    (note(arguments), ...);
    row.make = [call, all = std::tuple<Argument<T>...>(std::move(arguments)...)] {
        return std::make_unique<Case<Call, T...>>(call, all);
    };
    return table.rows.emplace_back(std::move(row));
}

}  // namespace motus::contracts
