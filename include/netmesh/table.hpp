// netmesh/table.hpp - netmesh::span, netmesh::table and netmesh::lists, the arrays of netmesh.hpp. Included by it.
// License: MIT OR Apache-2.0.

#ifndef NETMESH_TABLE_HPP
#define NETMESH_TABLE_HPP

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>
#if defined(__has_include)
#if __has_include(<version>)
#include <version>
#endif
#endif
#if defined(__cpp_lib_ranges)
#include <ranges>
#endif

namespace netmesh {

// Elements in a row that belong to somebody else: std::span, also before C++20. Each
// converts to the other, so that the types of this library do not depend on the language's version.
template <typename T>
class span {
public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using pointer = T *;
    using reference = T &;
    using iterator = T *;

    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    // Views an array, std::vector, std::array, std::span or whatever else has data() and size().
    // Only constant elements may come from a temporary.
    template <typename Container,
              typename Element = std::remove_pointer_t<decltype(std::data(std::declval<Container &>()))>,
              typename = decltype(std::size(std::declval<Container &>())),
              typename = std::enable_if_t<!std::is_same_v<std::decay_t<Container>, span> &&
                                          std::is_convertible_v<Element (*)[], T (*)[]> &&
                                          (std::is_lvalue_reference_v<Container> ||
                                           std::is_const_v<T>)>>
    constexpr span(Container &&container) noexcept
        : data_(std::data(container)), size_(std::size(container)) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }

    // Not checked, as in std::span.
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T &front() const noexcept { return data_[0]; }
    constexpr T &back() const noexcept { return data_[size_ - 1]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

// Rows of equal width, one after the other: row 0, row 1, ... A range of its rows, which are spans.
// They live as long as the table, and until it is moved from or assigned to.
template <typename T>
class table {
public:
    class iterator;
    using const_iterator = iterator;
    using value_type = span<const T>;
    using size_type = std::size_t;

    table() noexcept = default;

    // Takes elements, a multiple of width of them.
    table(std::vector<T> elements, std::size_t width) noexcept
        : elements_(std::move(elements)), width_(width) {}

    // Returns the number of rows.
    std::size_t size() const noexcept { return width_ == 0 ? 0 : elements_.size() / width_; }
    bool empty() const noexcept { return size() == 0; }
    // Returns the number of elements in a row.
    std::size_t width() const noexcept { return width_; }

    // Not checked.
    span<const T> operator[](std::size_t row) const noexcept {
        return {elements_.data() + row * width_, width_};
    }

    iterator begin() const noexcept { return {elements_.data(), width_}; }
    iterator end() const noexcept { return {elements_.data() + size() * width_, width_}; }

    // Returns all elements, size() * width() of them; of a temporary they are moved out.
    const T *data() const noexcept { return elements_.data(); }
    const std::vector<T> &flat() const & noexcept { return elements_; }
    std::vector<T> flat() && noexcept { return std::move(elements_); }

    friend bool operator==(const table &a, const table &b) {
        return a.width_ == b.width_ && a.elements_ == b.elements_;
    }
    friend bool operator!=(const table &a, const table &b) { return !(a == b); }

private:
    std::vector<T> elements_;
    std::size_t width_ = 0;
};

// Iterator with random access, as C++20 means it; for C++17, where a reference must be one, an
// input iterator.
template <typename T>
class table<T>::iterator {
public:
    using iterator_category = std::input_iterator_tag;
#if defined(__cpp_lib_ranges)
    using iterator_concept = std::random_access_iterator_tag;
#endif
    using value_type = span<const T>;
    using difference_type = std::ptrdiff_t;
    using reference = span<const T>;
    // Answer of ->, which holds the row.
    class pointer {
    public:
        const span<const T> *operator->() const noexcept { return &row_; }

    private:
        friend iterator;
        explicit pointer(span<const T> row) noexcept : row_(row) {}
        span<const T> row_;
    };

    iterator() noexcept = default;

    span<const T> operator*() const noexcept { return {first_, static_cast<std::size_t>(width_)}; }
    pointer operator->() const noexcept { return pointer(**this); }
    span<const T> operator[](std::ptrdiff_t n) const noexcept { return *(*this + n); }

    iterator &operator++() noexcept { return *this += 1; }
    iterator &operator--() noexcept { return *this += -1; }
    iterator operator++(int) noexcept { iterator old = *this; ++*this; return old; }
    iterator operator--(int) noexcept { iterator old = *this; --*this; return old; }
    iterator &operator+=(std::ptrdiff_t n) noexcept { first_ += n * width_; return *this; }
    iterator &operator-=(std::ptrdiff_t n) noexcept { return *this += -n; }
    friend iterator operator+(iterator i, std::ptrdiff_t n) noexcept { return i += n; }
    friend iterator operator+(std::ptrdiff_t n, iterator i) noexcept { return i += n; }
    friend iterator operator-(iterator i, std::ptrdiff_t n) noexcept { return i -= n; }
    friend std::ptrdiff_t operator-(iterator a, iterator b) noexcept {
        return a.first_ == b.first_ ? 0 : (a.first_ - b.first_) / a.width_;
    }

    friend bool operator==(iterator a, iterator b) noexcept { return a.first_ == b.first_; }
    friend bool operator!=(iterator a, iterator b) noexcept { return a.first_ != b.first_; }
    friend bool operator<(iterator a, iterator b) noexcept { return a.first_ < b.first_; }
    friend bool operator>(iterator a, iterator b) noexcept { return a.first_ > b.first_; }
    friend bool operator<=(iterator a, iterator b) noexcept { return a.first_ <= b.first_; }
    friend bool operator>=(iterator a, iterator b) noexcept { return a.first_ >= b.first_; }

private:
    friend table;
    iterator(const T *first, std::size_t width) noexcept
        : first_(first), width_(static_cast<std::ptrdiff_t>(width)) {}

    const T *first_ = nullptr;
    std::ptrdiff_t width_ = 0;
};

// Lists of several lengths, one after the other: a range of the lists, which are spans. They live as
// long as the whole, and until it is moved from or assigned to.
template <typename T>
class lists {
public:
    class iterator;
    using const_iterator = iterator;
    using value_type = span<const T>;
    using size_type = std::size_t;

    lists() noexcept = default;

    // Takes elements, and where each list begins among them: one number more than there are lists,
    // the last of them the number of elements.
    lists(std::vector<std::uint64_t> starts, std::vector<T> elements) noexcept
        : starts_(std::move(starts)), elements_(std::move(elements)) {}

    // Returns the number of lists.
    std::size_t size() const noexcept { return starts_.empty() ? 0 : starts_.size() - 1; }
    bool empty() const noexcept { return size() == 0; }

    // Not checked.
    span<const T> operator[](std::size_t i) const noexcept {
        return {elements_.data() + starts_[i], static_cast<std::size_t>(starts_[i + 1] - starts_[i])};
    }

    iterator begin() const noexcept { return {*this, 0}; }
    iterator end() const noexcept { return {*this, size()}; }

    // Return all elements, and where the lists begin among them; of a temporary they are moved out.
    const std::vector<T> &flat() const & noexcept { return elements_; }
    std::vector<T> flat() && noexcept { return std::move(elements_); }
    const std::vector<std::uint64_t> &starts() const & noexcept { return starts_; }
    std::vector<std::uint64_t> starts() && noexcept { return std::move(starts_); }

    friend bool operator==(const lists &a, const lists &b) {
        return a.starts_ == b.starts_ && a.elements_ == b.elements_;
    }
    friend bool operator!=(const lists &a, const lists &b) { return !(a == b); }

private:
    std::vector<std::uint64_t> starts_;
    std::vector<T> elements_;
};

// Forward iterator over the lists.
template <typename T>
class lists<T>::iterator {
public:
    using iterator_category = std::input_iterator_tag;
#if defined(__cpp_lib_ranges)
    using iterator_concept = std::forward_iterator_tag;
#endif
    using value_type = span<const T>;
    using difference_type = std::ptrdiff_t;
    using reference = span<const T>;
    using pointer = void;

    iterator() noexcept = default;

    span<const T> operator*() const noexcept { return (*lists_)[at_]; }
    iterator &operator++() noexcept { ++at_; return *this; }
    iterator operator++(int) noexcept { iterator old = *this; ++at_; return old; }
    friend bool operator==(iterator a, iterator b) noexcept { return a.at_ == b.at_; }
    friend bool operator!=(iterator a, iterator b) noexcept { return a.at_ != b.at_; }

private:
    friend lists;
    iterator(const lists &of, std::size_t at) noexcept : lists_(&of), at_(at) {}

    const lists *lists_ = nullptr;
    std::size_t at_ = 0;
};

}  // namespace netmesh

#if defined(__cpp_lib_ranges)
template <typename T>
inline constexpr bool std::ranges::enable_borrowed_range<netmesh::span<T>> = true;
template <typename T>
inline constexpr bool std::ranges::enable_view<netmesh::span<T>> = true;
#endif

#endif  // NETMESH_TABLE_HPP
