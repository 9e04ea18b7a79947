-- As many locals as a function may have, a deep expression and a long chain of branches.
function locals(time)
  local v0 = time * 0
  local v1 = time * 1
  local v2 = time * 2
  local v3 = time * 3
  local v4 = time * 4
  local v5 = time * 5
  local v6 = time * 6
  local v7 = time * 7
  local v8 = time * 8
  local v9 = time * 9
  local v10 = time * 10
  local v11 = time * 11
  local v12 = time * 12
  local v13 = time * 13
  local v14 = time * 14
  local v15 = time * 15
  local v16 = time * 16
  local v17 = time * 17
  local v18 = time * 18
  local v19 = time * 19
  local v20 = time * 20
  local v21 = time * 21
  local v22 = time * 22
  local v23 = time * 23
  local v24 = time * 24
  local v25 = time * 25
  local v26 = time * 26
  local v27 = time * 27
  local v28 = time * 28
  local v29 = time * 29
  local v30 = time * 30
  local v31 = time * 31
  local v32 = time * 32
  local v33 = time * 33
  local v34 = time * 34
  local v35 = time * 35
  local v36 = time * 36
  local v37 = time * 37
  local v38 = time * 38
  local v39 = time * 39
  local v40 = time * 40
  local v41 = time * 41
  local v42 = time * 42
  local v43 = time * 43
  local v44 = time * 44
  local v45 = time * 45
  local v46 = time * 46
  local v47 = time * 47
  local v48 = time * 48
  local v49 = time * 49
  local v50 = time * 50
  local v51 = time * 51
  local v52 = time * 52
  local v53 = time * 53
  local v54 = time * 54
  local v55 = time * 55
  local v56 = time * 56
  local v57 = time * 57
  local v58 = time * 58
  local v59 = time * 59
  local v60 = time * 60
  local v61 = time * 61
  local v62 = time * 62
  local v63 = time * 63
  local v64 = time * 64
  local v65 = time * 65
  local v66 = time * 66
  local v67 = time * 67
  local v68 = time * 68
  local v69 = time * 69
  local v70 = time * 70
  local v71 = time * 71
  local v72 = time * 72
  local v73 = time * 73
  local v74 = time * 74
  local v75 = time * 75
  local v76 = time * 76
  local v77 = time * 77
  local v78 = time * 78
  local v79 = time * 79
  local v80 = time * 80
  local v81 = time * 81
  local v82 = time * 82
  local v83 = time * 83
  local v84 = time * 84
  local v85 = time * 85
  local v86 = time * 86
  local v87 = time * 87
  local v88 = time * 88
  local v89 = time * 89
  local v90 = time * 90
  local v91 = time * 91
  local v92 = time * 92
  local v93 = time * 93
  local v94 = time * 94
  local v95 = time * 95
  local v96 = time * 96
  local v97 = time * 97
  local v98 = time * 98
  local v99 = time * 99
  local v100 = time * 100
  local v101 = time * 101
  local v102 = time * 102
  local v103 = time * 103
  local v104 = time * 104
  local v105 = time * 105
  local v106 = time * 106
  local v107 = time * 107
  local v108 = time * 108
  local v109 = time * 109
  local v110 = time * 110
  local v111 = time * 111
  local v112 = time * 112
  local v113 = time * 113
  local v114 = time * 114
  local v115 = time * 115
  local v116 = time * 116
  local v117 = time * 117
  local v118 = time * 118
  local v119 = time * 119
  local v120 = time * 120
  local v121 = time * 121
  local v122 = time * 122
  local v123 = time * 123
  local v124 = time * 124
  local v125 = time * 125
  local v126 = time * 126
  local v127 = time * 127
  local v128 = time * 128
  local v129 = time * 129
  local v130 = time * 130
  local v131 = time * 131
  local v132 = time * 132
  local v133 = time * 133
  local v134 = time * 134
  local v135 = time * 135
  local v136 = time * 136
  local v137 = time * 137
  local v138 = time * 138
  local v139 = time * 139
  local v140 = time * 140
  local v141 = time * 141
  local v142 = time * 142
  local v143 = time * 143
  local v144 = time * 144
  local v145 = time * 145
  local v146 = time * 146
  local v147 = time * 147
  local v148 = time * 148
  local v149 = time * 149
  local v150 = time * 150
  local v151 = time * 151
  local v152 = time * 152
  local v153 = time * 153
  local v154 = time * 154
  local v155 = time * 155
  local v156 = time * 156
  local v157 = time * 157
  local v158 = time * 158
  local v159 = time * 159
  local v160 = time * 160
  local v161 = time * 161
  local v162 = time * 162
  local v163 = time * 163
  local v164 = time * 164
  local v165 = time * 165
  local v166 = time * 166
  local v167 = time * 167
  local v168 = time * 168
  local v169 = time * 169
  local v170 = time * 170
  local v171 = time * 171
  local v172 = time * 172
  local v173 = time * 173
  local v174 = time * 174
  local v175 = time * 175
  local v176 = time * 176
  local v177 = time * 177
  local v178 = time * 178
  local v179 = time * 179
  local v180 = time * 180
  local v181 = time * 181
  local v182 = time * 182
  local v183 = time * 183
  local v184 = time * 184
  local v185 = time * 185
  local v186 = time * 186
  local v187 = time * 187
  local v188 = time * 188
  local v189 = time * 189
  local v190 = time * 190
  local v191 = time * 191
  local v192 = time * 192
  local v193 = time * 193
  local v194 = time * 194
  return v0 + v194 + v100
end
-- run: locals time=2
-- expect: 588
function deep(time) return ((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((time + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) + 1) end
-- run: deep time=0.5
-- expect: 100.5
function chain(frame)
  if frame == 0 then return 0
  elseif frame == 3 then return 1
  elseif frame == 6 then return 2
  elseif frame == 9 then return 3
  elseif frame == 12 then return 4
  elseif frame == 15 then return 5
  elseif frame == 18 then return 6
  elseif frame == 21 then return 7
  elseif frame == 24 then return 8
  elseif frame == 27 then return 9
  elseif frame == 30 then return 10
  elseif frame == 33 then return 11
  elseif frame == 36 then return 12
  elseif frame == 39 then return 13
  elseif frame == 42 then return 14
  elseif frame == 45 then return 15
  elseif frame == 48 then return 16
  elseif frame == 51 then return 17
  elseif frame == 54 then return 18
  elseif frame == 57 then return 19
  elseif frame == 60 then return 20
  elseif frame == 63 then return 21
  elseif frame == 66 then return 22
  elseif frame == 69 then return 23
  elseif frame == 72 then return 24
  elseif frame == 75 then return 25
  elseif frame == 78 then return 26
  elseif frame == 81 then return 27
  elseif frame == 84 then return 28
  elseif frame == 87 then return 29
  elseif frame == 90 then return 30
  elseif frame == 93 then return 31
  elseif frame == 96 then return 32
  elseif frame == 99 then return 33
  elseif frame == 102 then return 34
  elseif frame == 105 then return 35
  elseif frame == 108 then return 36
  elseif frame == 111 then return 37
  elseif frame == 114 then return 38
  elseif frame == 117 then return 39
  elseif frame == 120 then return 40
  elseif frame == 123 then return 41
  elseif frame == 126 then return 42
  elseif frame == 129 then return 43
  elseif frame == 132 then return 44
  elseif frame == 135 then return 45
  elseif frame == 138 then return 46
  elseif frame == 141 then return 47
  elseif frame == 144 then return 48
  elseif frame == 147 then return 49
  elseif frame == 150 then return 50
  elseif frame == 153 then return 51
  elseif frame == 156 then return 52
  elseif frame == 159 then return 53
  elseif frame == 162 then return 54
  elseif frame == 165 then return 55
  elseif frame == 168 then return 56
  elseif frame == 171 then return 57
  elseif frame == 174 then return 58
  elseif frame == 177 then return 59
  end
  return -1
end
-- run: chain frame=33
-- expect: 11
-- run: chain frame=34
-- expect: -1
function sum(p) return p.x * 0 + p.y * 1 + p.z * 2 + p.x * 3 + p.y * 4 + p.z * 5 + p.x * 6 + p.y * 7 + p.z * 8 + p.x * 9 + p.y * 10 + p.z * 11 + p.x * 12 + p.y * 13 + p.z * 14 + p.x * 15 + p.y * 16 + p.z * 17 + p.x * 18 + p.y * 19 + p.z * 20 + p.x * 21 + p.y * 22 + p.z * 23 + p.x * 24 + p.y * 25 + p.z * 26 + p.x * 27 + p.y * 28 + p.z * 29 + p.x * 30 + p.y * 31 + p.z * 32 + p.x * 33 + p.y * 34 + p.z * 35 + p.x * 36 + p.y * 37 + p.z * 38 + p.x * 39 + p.y * 40 + p.z * 41 + p.x * 42 + p.y * 43 + p.z * 44 + p.x * 45 + p.y * 46 + p.z * 47 + p.x * 48 + p.y * 49 + p.z * 50 + p.x * 51 + p.y * 52 + p.z * 53 + p.x * 54 + p.y * 55 + p.z * 56 + p.x * 57 + p.y * 58 + p.z * 59 + p.x * 60 + p.y * 61 + p.z * 62 + p.x * 63 + p.y * 64 + p.z * 65 + p.x * 66 + p.y * 67 + p.z * 68 + p.x * 69 + p.y * 70 + p.z * 71 + p.x * 72 + p.y * 73 + p.z * 74 + p.x * 75 + p.y * 76 + p.z * 77 + p.x * 78 + p.y * 79 end
