PRAGMA user_version=1;
BEGIN TRANSACTION;
CREATE TABLE actions (
	session VARCHAR(32) NOT NULL, 
	n INTEGER NOT NULL, 
	t FLOAT NOT NULL, 
	action TEXT NOT NULL, 
	PRIMARY KEY (session, n)
)
 WITHOUT ROWID

;
INSERT INTO "actions" VALUES('056aa183682042acccef8d2ebf25715a',1,1795934451.726,'{"do":"choose_robot","robot":"ur5"}');
INSERT INTO "actions" VALUES('056aa183682042acccef8d2ebf25715a',2,1795934451.732,'{"do":"move","q":[0.1,-1.2,1.3,-0.4,0.5,0.6]}');
INSERT INTO "actions" VALUES('eab0a8c81eb91fac6bc0935bf1ed1374',1,1795934451.749,'{"do":"choose_robot","robot":"ur10e"}');
CREATE TABLE owned (
	session VARCHAR(32) NOT NULL, 
	owner VARCHAR(64) NOT NULL, 
	title VARCHAR(120) NOT NULL, 
	opened FLOAT NOT NULL, 
	PRIMARY KEY (session)
);
INSERT INTO "owned" VALUES('056aa183682042acccef8d2ebf25715a','aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','Monday''s cell',1.79593445173657512668e+09);
CREATE TABLE scores (
	id INTEGER NOT NULL, 
	trainee VARCHAR(80) NOT NULL, 
	session VARCHAR(32) NOT NULL, 
	exercise VARCHAR(80) NOT NULL, 
	begun FLOAT NOT NULL, 
	total FLOAT NOT NULL, 
	card TEXT NOT NULL, 
	PRIMARY KEY (id)
);
INSERT INTO "scores" VALUES(1,'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','056aa183682042acccef8d2ebf25715a','first_tool',1000.0,100.0,'{"exercise":"first_tool","seed":3,"begun":1000.0,"seconds":165.0,"total":100.0,"parts":[{"key":"accuracy","value":1.0,"weight":50.0},{"key":"time","value":1.0,"weight":10.0},{"key":"travel","value":1.0,"weight":5.0},{"key":"care","value":1.0,"weight":15.0},{"key":"tidy","value":1.0,"weight":5.0}],"figures":{"travel_m":2.662,"near_misses":0.0,"closest_mm":17.4932,"touch_mm":0.3605,"tool_mm":0.2043,"residual_mm":0.3316,"sigma_mm":0.4675,"seconds":165.0,"records":4.0,"repeats":0.0,"calculations":1.0},"truth":{"tool_x_mm":122.9025,"tool_y_mm":-0.4416,"tool_z_mm":360.8829},"answer":"nothing","number":0,"right_answer":"","right_number":0,"given_up":false,"advice":[{"code":"well","fields":{}}]}');
CREATE TABLE sessions (
	name VARCHAR(32) NOT NULL, 
	created FLOAT NOT NULL, 
	PRIMARY KEY (name)
);
INSERT INTO "sessions" VALUES('056aa183682042acccef8d2ebf25715a',1.79593445170271134381e+09);
INSERT INTO "sessions" VALUES('eab0a8c81eb91fac6bc0935bf1ed1374',1.79593445174362683291e+09);
CREATE INDEX ix_owned_owner ON owned (owner);
CREATE INDEX ix_scores_trainee ON scores (trainee);
COMMIT;
