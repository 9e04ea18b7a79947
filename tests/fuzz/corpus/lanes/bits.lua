-- Bitwise operators on 64 bits.
function bits(frame, id) return frame & id, frame | id, frame ~ id, ~frame end
-- run: bits frame=12 id=10
-- expect: 8, 14, 6, -13
-- run: bits frame=-1 id=9223372036854775807
-- expect: 9223372036854775807, -1, -9223372036854775808, 0

function scramble(frame, id)
  local h = frame * 0x9E3779B97F4A7C15 + id
  h = (h ~ (h >> 30)) * 0xBF58476D1CE4E5B9
  h = (h ~ (h >> 27)) * 0x94D049BB133111EB
  return h ~ (h >> 31)
end
-- run: scramble frame=0 id=0
-- expect: 0
-- run: scramble frame=0 id=-7046029254386353131
-- expect: -2152535657050944081

function precedence(frame, id) return frame | id & 3 << 1 ~ 5, frame & 3 == 1, not (frame & 1 ~= 0) end
-- run: precedence frame=5 id=7
-- expect: 7, true, false
