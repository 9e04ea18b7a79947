-- Comments, line ends and blanks anywhere.
function --[[ a ]] height --[==[ b
]==] (p) -- c
  return--d
    p . x+--[[e]]p
      . y --
end
-- run: height p=1,2,3
-- expect: 3
function tight(p)local a=p.x;local b=a+1 return a*b end
