#pragma once

#include <cmath>

namespace weft {

/// A point or vector of the plane.
template <class T>
struct Vec2 {
  T x{}, y{};
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

/// A point or vector of space. Right-handed, y up, metres unless said otherwise.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Vec2d = Vec2<double>;
using Vec2f = Vec2<float>;
using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;

template <class T>
constexpr Vec2<T> operator+(Vec2<T> a, Vec2<T> b) {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
constexpr Vec2<T> operator-(Vec2<T> a, Vec2<T> b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
constexpr Vec2<T> operator*(T s, Vec2<T> a) {
  return {s * a.x, s * a.y};
}
template <class T>
constexpr T dot(Vec2<T> a, Vec2<T> b) {
  return a.x * b.x + a.y * b.y;
}
/// Twice the signed area of the triangle (0, a, b): positive when b is to the left of a.
template <class T>
constexpr T cross(Vec2<T> a, Vec2<T> b) {
  return a.x * b.y - a.y * b.x;
}

template <class T>
constexpr Vec3<T> operator+(Vec3<T> a, Vec3<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vec3<T> operator-(Vec3<T> a, Vec3<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vec3<T> operator-(Vec3<T> a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vec3<T> operator*(T s, Vec3<T> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
constexpr Vec3<T>& operator+=(Vec3<T>& a, Vec3<T> b) {
  return a = a + b;
}
template <class T>
constexpr Vec3<T>& operator-=(Vec3<T>& a, Vec3<T> b) {
  return a = a - b;
}
template <class T>
constexpr T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class V>
constexpr auto squared_length(V a) {
  return dot(a, a);
}
template <class V>
auto length(V a) {
  return std::sqrt(dot(a, a));
}
/// a / |a|, or zero for the zero vector.
template <class V>
V normalized(V a) {
  const auto l = length(a);
  return l > 0 ? (1 / l) * a : V{};
}

template <class To, class From>
constexpr Vec3<To> vec_cast(Vec3<From> a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

/// Componentwise minimum and maximum.
template <class T>
constexpr Vec3<T> min(Vec3<T> a, Vec3<T> b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
template <class T>
constexpr Vec3<T> max(Vec3<T> a, Vec3<T> b) {
  return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}

/// An axis-aligned box; empty (lower > upper) until a point is added.
struct Box3d {
  Vec3d lower{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  Vec3d upper{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  void add(Vec3d p) {
    lower = min(lower, p);
    upper = max(upper, p);
  }
  [[nodiscard]] bool empty() const { return lower.x > upper.x; }
  [[nodiscard]] Vec3d extent() const { return upper - lower; }
  [[nodiscard]] Vec3d centre() const { return 0.5 * (lower + upper); }
  [[nodiscard]] double diagonal() const { return length(extent()); }
};

}  // namespace weft
