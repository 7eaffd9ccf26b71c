#!/usr/bin/env bash
# draws_self_test.sh PYTHON: proves that draws_in_order.py finds each kind of fault, and none where there is none.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
file=$(mktemp --suffix .cpp)
trap 'rm -f "$file"' EXIT
failures=0
python=$1

# A function with a generator, a lambda that draws from it, and the line in question.
check() {
    printf '%s\n' 'float number(Pcg32& generator);' 'struct Maker { Pcg32 random_; float draw(); };' \
        'float Maker::draw() { return random_.uniform(); }' 'void f() {' '    Pcg32 random(1);' \
        '    const auto draw = [&] { return random.uniform(-1, 1); };' "    $1" '}' >"$file"
    "$python" "$here/draws_in_order.py" "$file"
}
finds() {
    local said
    if said=$(check "$1"); then
        echo "not found: $1" && failures=1
    elif ! grep -q ':7: ' <<<"$said"; then
        echo "found elsewhere: $1: $said" && failures=1
    fi
}
passes() { check "$1" || { echo "refused: $1" && failures=1; }; }

finds 'const Point2 p(random.uniform(), random.uniform());'
finds 'use(random.next(), 2, random.below(3));'
finds 'use(draw(), draw());'
finds 'use(number(random), number(random));'
finds 'use(3 * draw(), std::max(1.0f, draw()));'
finds 'const float x = draw() + draw();'
finds 'const float x = 2 * (1 + draw()) - number(random);'
finds 'if (random.below(2) == random.below(2)) return;'
finds 'use([&] { return Point2(draw(), draw()); });'
finds 'use([](Pcg32& other) { return Point2(other.uniform(), other.uniform()); });'
finds 'for (int i = 0; i < 3; ++i) use(Point2(random.uniform(), random.uniform()));'
finds 'Point2 p{1, 2}; p = Point2(draw(), draw());'
finds 'struct Other { Point2 p() { return Point2(random_.next(), random_.next()); } Pcg32 random_{1}; };'
finds 'const Point2 p = b ? Point2(draw(), draw()) : Point2(0);'
passes 'const Point2 p{random.uniform(), random.uniform()};'
passes 'use({draw(), draw()});'
passes 'const float x = draw(), y = draw();'
passes 'use(draw()); use(draw());'
passes 'const float x = b ? draw() : 2 * draw();'
passes 'if (random.below(2) && random.below(3)) use(draw());'
passes 'use(draw(), [&] { return draw(); });'
passes 'struct Other { Pcg32 random_; float x() { return random_.uniform(); } };'
passes 'values[random.below(3)] = draw();'
passes 'out << draw() << draw();'
passes 'use("random.uniform() + random.uniform()"); // draw() + draw()'
passes 'for (int i = random.below(3); i < 3; ++i) use(draw());'
passes '{ const auto other = [&] { return 1; }; use(other(), other()); }'
exit $failures
