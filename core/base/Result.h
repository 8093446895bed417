// A value or the reason why there is none: how every failure of the world (files, drivers,
// shaders, user data) travels through Patina. Programmer errors use CHECK (core/base/Check.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace patina {

// What went wrong, coarse enough that the command line can derive its exit status from it.
enum class ErrorKind {
    Usage,        // the request itself makes no sense
    InputBroken,  // a file could be read, but what it holds is damaged or unsupported
    InputMissing, // a file is not there or cannot be read
    NoOpenGl,     // no OpenGL context, or one that is too old
    Internal,     // a fault of ours
    CannotCreate, // an output cannot be created
    Io,           // writing failed half-way: disk full, I/O error
    Cancelled,    // the user said so
};

struct Error {
    ErrorKind kind = ErrorKind::Internal;
    std::string message;        // one sentence for the user: what failed and what to do about it
    std::filesystem::path file; // the file concerned, empty when there is none
    std::string detail;         // what the library said, for the log

    // "chair.obj: the file has no faces; export it with geometry (assimp: …)"
    [[nodiscard]] std::string text() const {
        std::string result = file.empty() ? message : file.string() + ": " + message;
        if (!detail.empty())
            result += " (" + detail + ")";
        return result;
    }
};

template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) // NOLINT: implicit on purpose, so that functions can `return value;`
        : m_state(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) // NOLINT: implicit on purpose
        : m_state(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return m_state.index() == 0; }
    explicit operator bool() const { return ok(); }

    // value() and error() throw std::bad_variant_access on misuse, a programmer error.
    [[nodiscard]] T& value() & { return std::get<0>(m_state); }
    [[nodiscard]] const T& value() const& { return std::get<0>(m_state); }
    [[nodiscard]] T&& value() && { return std::get<0>(std::move(m_state)); }
    [[nodiscard]] const Error& error() const { return std::get<1>(m_state); }

    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

  private:
    std::variant<T, Error> m_state;
};

template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) // NOLINT: implicit on purpose
        : m_error(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !m_error.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const { return m_error.value(); }

  private:
    std::optional<Error> m_error;
};

} // namespace patina
