-- not (a < b) is not a >= b where one of them is NaN.
function negated(time, fw) return not (time < fw), not (time <= fw), not (time > fw), not (time >= fw), not (time == fw), not (time ~= fw) end
-- run: negated time=nan fw=1
-- expect: true, true, true, true, true, false
function branches(time, fw)
  local r = 0
  if not (time < fw) then r = r + 1 end
  if time >= fw then r = r + 10 else r = r + 20 end
  if not (time > fw) and not (time < fw) then r = r + 100 end
  return r
end
-- run: branches time=nan fw=1
-- expect: 121
-- run: branches time=1 fw=1
-- expect: 111
function loops(time)
  local k = 0
  while not (k > time) do
    k = k + 1
    if k == 30 then break end
  end
  repeat k = k + 1 until not (k < time) or k > 40
  return k
end
-- run: loops time=3
-- expect: 5
-- run: loops time=nan
-- expect: 31
function chosen(time, fw) return not (time < fw) and time or fw, time < fw and time or fw end
