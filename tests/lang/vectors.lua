-- Vectors are values; operators work by component, with a number on either side too.
function arithmetic(p, n) return p + n, p - n, p * n, p / n, -p end
-- run: arithmetic p=1,2,3 n=4,5,8
-- expect: 5, 7, 11, -3, -3, -5, 4, 10, 24, 0.25, 0.40000000000000002, 0.375, -1, -2, -3

function with_numbers(p, time) return p * time, time * p, p + 1, 2 - p, p / 2, 1 / p end
-- run: with_numbers p=1,2,4 time=3
-- expect: 3, 6, 12, 3, 6, 12, 2, 3, 5, 1, 0, -2, 0.5, 1, 2, 1, 0.5, 0.25

function with_integers(p, frame) return p * frame, frame + p end
-- run: with_integers p=1,2,3 frame=2
-- expect: 2, 4, 6, 3, 4, 5

function flooring(p, n) return p // n, p % n, p ^ 2 end
-- run: flooring p=7,-7,7.5 n=2,2,-2
-- expect: 3, -4, -4, 1, 1, -0.5, 49, 49, 56.25

function flooring_by_number(p, fw) return p // fw, p % fw, p ^ fw, fw ^ p, fw // p, fw % p end
-- run: flooring_by_number p=1,-2,3 fw=2
-- expect: 0, -1, 1, 1, -0, 1, 1, 4, 9, 2, 0.25, 8, 2, -1, 0, 0, 0, 2
