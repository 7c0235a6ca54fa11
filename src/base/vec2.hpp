#pragma once
// Vectors of the plane, for any scalar: double, a pack, a dual number.

namespace gneiss {

template <class T>
struct Vec2 {
    T x, y;

    friend Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator-(const Vec2& a) { return {-a.x, -a.y}; }
    template <class S>
    friend Vec2 operator*(const S& s, const Vec2& a) {
        return {s * a.x, s * a.y};
    }
    Vec2& operator+=(const Vec2& b) {
        x += b.x;
        y += b.y;
        return *this;
    }
};

template <class T>
T dot(const Vec2<T>& a, const Vec2<T>& b) {
    return a.x * b.x + a.y * b.y;
}

/// z component of the vector product, a x b.
template <class T>
T cross(const Vec2<T>& a, const Vec2<T>& b) {
    return a.x * b.y - a.y * b.x;
}

/// r(n) of FORMULATION 3: n turned by +90 degrees.
template <class T>
Vec2<T> turned(const Vec2<T>& n) {
    return {-n.y, n.x};
}

}  // namespace gneiss
