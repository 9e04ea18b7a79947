-- Integers to numbers and back, at the edges.
function to_number(frame) return frame + 0.0, frame * 1.0, frame / 1, -frame + 0.0 end
-- run: to_number frame=9223372036854775807
-- expect: 9.2233720368547758e+18, 9.2233720368547758e+18, 9.2233720368547758e+18, -9.2233720368547758e+18
-- run: to_number frame=9007199254740993
-- expect: 9007199254740992, 9007199254740992, 9007199254740992, -9007199254740992
function exact(time) return math.tointeger(time) end
-- run: exact time=3
-- expect: 3
-- run: exact time=-0.0
-- expect: 0
-- run: exact time=3.5
-- expect: fault: integer-range
-- run: exact time=9223372036854775808
-- expect: fault: integer-range
function there_and_back(frame) return math.floor((frame & 0xffff) + 0.5), math.ceil((frame & 0xffff) - 0.5) end
-- run: there_and_back frame=-1
-- expect: 65535, 65535
