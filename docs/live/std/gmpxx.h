// Whole numbers of any length, for the exact corners of chapter 3: what of GMP's C++ interface the
// book uses, as school teaches it. A page's numbers have some thirty words; GMP is not among what
// can be linked into a page.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// A sign and a size, as GMP has it.
class mpz_class {
  public:
    mpz_class() = default;
    /// The whole part of a finite number.
    explicit mpz_class(double value) : negative_(value < 0.0) {
        int exponent = 0;
        const double fraction = std::frexp(std::abs(value), &exponent);  // in [1/2, 1), or 0
        if (exponent <= 0) return;
        auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 64));
        words_.assign(static_cast<std::size_t>(exponent + 31) / 32, 0);
        // The bits stand at the top of the number; from word to word downwards the next 32 of them.
        int used = (exponent - 1) % 32 + 1;
        for (std::size_t i = words_.size(); i-- > 0 && bits != 0; used = 32) {
            words_[i] = static_cast<std::uint32_t>(bits >> (64 - used));
            bits <<= used;
        }
    }

    friend mpz_class operator-(mpz_class a) {
        a.negative_ = !a.negative_;
        return a;
    }
    friend mpz_class operator+(const mpz_class& a, const mpz_class& b) {
        mpz_class result;
        const bool same = a.negative_ == b.negative_, larger = !smaller(a.words_, b.words_);
        const mpz_class &more = larger ? a : b, &less = larger ? b : a;
        std::int64_t carry = 0;
        for (std::size_t i = 0; i < more.words_.size(); ++i) {
            const std::int64_t word = i < less.words_.size() ? less.words_[i] : 0;
            carry += more.words_[i] + (same ? word : -word);
            result.words_.push_back(static_cast<std::uint32_t>(carry));
            carry >>= 32;
        }
        result.words_.push_back(static_cast<std::uint32_t>(carry));
        result.trim(more.negative_);
        return result;
    }
    friend mpz_class operator-(const mpz_class& a, const mpz_class& b) { return a + -b; }
    friend mpz_class operator*(const mpz_class& a, const mpz_class& b) {
        mpz_class result;
        result.words_.assign(a.words_.size() + b.words_.size(), 0);
        for (std::size_t i = 0; i < a.words_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t k = 0; k < b.words_.size(); ++k) {
                carry += std::uint64_t{a.words_[i]} * b.words_[k] + result.words_[i + k];
                result.words_[i + k] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
            result.words_[i + b.words_.size()] = static_cast<std::uint32_t>(carry);
        }
        result.trim(a.negative_ != b.negative_);
        return result;
    }
    mpz_class& operator+=(const mpz_class& b) { return *this = *this + b; }

    friend int sgn(const mpz_class& a) { return a.words_.empty() ? 0 : a.negative_ ? -1 : 1; }

    const mpz_class& get_mpz_t() const { return *this; }
    /// The first 53 bits as a number in [1/2, 1), times 2^exponent: the rest is cut off.
    friend double mpz_get_d_2exp(long* exponent, const mpz_class& a) {
        *exponent = 0;
        if (a.words_.empty()) return 0.0;
        std::uint64_t bits = 0;  // the first 64
        int free = 64;
        for (std::size_t i = a.words_.size(); i-- > 0 && free > 0;) {
            const int shift = i + 1 == a.words_.size() ? __builtin_clz(a.words_[i]) : 0,
                      width = 32 - shift;
            bits |= width <= free ? std::uint64_t{a.words_[i]} << (free - width)
                                  : std::uint64_t{a.words_[i]} >> (width - free);
            free -= width;
        }
        *exponent = static_cast<long>(32 * a.words_.size()) - __builtin_clz(a.words_.back());
        const double fraction = std::ldexp(static_cast<double>(bits >> 11), -53);
        return a.negative_ ? -fraction : fraction;
    }

  private:
    using Words = std::vector<std::uint32_t>;  ///< the lowest first; the last is not 0
    static bool smaller(const Words& a, const Words& b) {
        if (a.size() != b.size()) return a.size() < b.size();
        for (std::size_t i = a.size(); i-- > 0;)
            if (a[i] != b[i]) return a[i] < b[i];
        return false;
    }
    void trim(bool negative) {
        while (!words_.empty() && words_.back() == 0) words_.pop_back();
        negative_ = negative && !words_.empty();
    }

    bool negative_ = false;
    Words words_;
};

/// Only named in a page: exact points are no figure's business.
class mpq_class {
  public:
    mpq_class() = default;
    mpq_class(double) {}
    mpq_class(const mpz_class&, const mpz_class&) {}
    void canonicalize() {}
    mpq_class& get_mpq_t() { return *this; }
};
inline void mpq_div_2exp(mpq_class&, const mpq_class&, unsigned long) {}
